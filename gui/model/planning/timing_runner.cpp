#include "model/planning/timing_runner.h"

#include "handway/geometric/collision/volumes/preparation.h"

#include <utility>

namespace handway::gui {

TimingRunner::TimingRunner(QObject* parent) : QObject(parent) {
  connect(&job_, &LatestJob::failed, this, &TimingRunner::failed);
}

void TimingRunner::start(std::shared_ptr<const PreparedProblem> problem, planning::Path path,
                         const std::string& name, const planning::TimingOptions& options) {
  job_.run([this, problem = std::move(problem), path = std::move(path), name,
            options](const std::stop_token& stop) -> LatestJob::Answer {
    const PreparedProblem::Problem ready = problem->wait(stop);
    if (!ready) {
      return {};
    }
    const auto motion =
        std::make_shared<const planning::TimedPath>(time_path(*ready, path, name, options));
    return [this, motion, revision = problem->revision()] { emit timed({motion, revision}); };
  });
}

void TimingRunner::start(const DerivedSource& source, const std::string& name,
                         const planning::TimingOptions& options) {
  job_.run([this, source, name, options](const std::stop_token& stop) -> LatestJob::Answer {
    planning::TimingOptions stoppable = options;
    stoppable.stop = stop;
    try {
      const auto motion =
          std::make_shared<const planning::TimedPath>(source.value.time(name, stoppable));
      return [this, motion, revision = source.made_from] { emit timed({motion, revision}); };
    } catch (const geometric::PreparationStopped&) {
      return {};
    }
  });
}

}  // namespace handway::gui
