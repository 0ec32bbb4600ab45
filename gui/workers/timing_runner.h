#pragma once

#include "handway/planning/timing/time_path.h"
#include "workers/latest_job.h"
#include "workers/prepared_problem.h"

#include <QObject>
#include <QString>

#include <memory>

namespace handway::gui {

/// Makes motions of paths off the GUI thread. Only the answer to the latest request counts.
class TimingRunner : public QObject {
  Q_OBJECT

 public:
  explicit TimingRunner(QObject* parent = nullptr) : QObject(parent) {}

  /// @param name of the motion. timed() or failed() follows.
  void start(std::shared_ptr<const PreparedProblem> problem, planning::Path path,
             const std::string& name, const planning::TimingOptions& options);
  /// No answer is wanted any more.
  void forget() { job_.cancel(); }

 signals:
  void timed(const std::shared_ptr<const handway::planning::TimedPath>& motion);
  void failed(const QString& message);

 private:
  LatestJob job_;
};

}  // namespace handway::gui
