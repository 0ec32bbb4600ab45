#pragma once

#include "handway/planning/timing/time_path.h"
#include "workers/background_threads.h"
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
  ~TimingRunner() override;

  /// @param name of the motion. timed() or failed() follows.
  void start(std::shared_ptr<const PreparedProblem> problem, planning::Path path,
             const std::string& name, const planning::TimingOptions& options);
  /// No answer is wanted any more.
  void forget() { ++asked_; }

 signals:
  void timed(const std::shared_ptr<const handway::planning::TimedPath>& motion);
  void failed(const QString& message);

 private:
  int asked_ = 0;
  std::stop_source stop_;
  BackgroundThreads threads_;
};

}  // namespace handway::gui
