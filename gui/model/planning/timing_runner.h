#pragma once

#include "handway/planning/core/plan_result.h"
#include "handway/planning/timing/time_path.h"
#include "model/document/prepared_problem.h"
#include "model/jobs/background.h"
#include "model/planning/motion_source.h"

#include <QObject>
#include <QString>

#include <memory>

namespace handway::gui {

/// A motion, and the revision that it was timed and checked in.
using DerivedMotion = planning::Derived<std::shared_ptr<const planning::TimedPath>>;

/// Makes motions of paths and of other sources off the GUI thread. Only the answer to the latest
/// request counts.
class TimingRunner : public QObject {
  Q_OBJECT

 public:
  explicit TimingRunner(QObject* parent = nullptr);

  /// @param name of the motion. timed(), made from the problem's revision, or failed() follows.
  void start(std::shared_ptr<const PreparedProblem> problem, planning::Path path,
             const std::string& name, const planning::TimingOptions& options);
  /// Makes the motion of a source; timed(), made from the source's revision, or failed() follows.
  void start(const DerivedSource& source, const std::string& name,
             const planning::TimingOptions& options);
  /// No answer is wanted any more.
  void forget() { job_.cancel(); }
  /// Returns whether an answer is still expected.
  [[nodiscard]] bool is_busy() const { return job_.is_busy(); }

 signals:
  void timed(const handway::gui::DerivedMotion& motion);
  void failed(const QString& message);

 private:
  LatestJob job_;
};

}  // namespace handway::gui
