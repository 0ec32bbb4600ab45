#include "workers/timing_runner.h"

#include <exception>
#include <utility>

namespace handway::gui {

TimingRunner::~TimingRunner() {
  blockSignals(true);
  stop_.request_stop();
}

void TimingRunner::start(std::shared_ptr<const PreparedProblem> problem, planning::Path path,
                         const std::string& name, const planning::TimingOptions& options) {
  threads_.run([this, ticket = ++asked_, stop = stop_.get_token(), problem = std::move(problem),
                path = std::move(path), name, options] {
    std::shared_ptr<const planning::TimedPath> motion;
    QString message;
    try {
      const PreparedProblem::Problem ready = problem->wait(stop);
      if (!ready) {
        return;
      }
      motion = std::make_shared<planning::TimedPath>(time_path(*ready, path, name, options));
    } catch (const std::exception& error) {
      message = QString::fromUtf8(error.what());
    }
    QMetaObject::invokeMethod(
        this,
        [this, ticket, motion, message] {
          if (ticket != asked_) {
            return;
          }
          if (motion) {
            emit timed(motion);
          } else {
            emit failed(message);
          }
        },
        Qt::QueuedConnection);
  });
}

}  // namespace handway::gui
