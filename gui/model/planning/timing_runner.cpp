#include "model/planning/timing_runner.h"

#include <exception>
#include <utility>

namespace handway::gui {

void TimingRunner::start(std::shared_ptr<const PreparedProblem> problem, planning::Path path,
                         const std::string& name, const planning::TimingOptions& options) {
  job_.run([this, problem = std::move(problem), path = std::move(path), name,
            options](const std::stop_token& stop) -> LatestJob::Answer {
    try {
      const PreparedProblem::Problem ready = problem->wait(stop);
      if (!ready) {
        return {};
      }
      const auto motion =
          std::make_shared<const planning::TimedPath>(time_path(*ready, path, name, options));
      return [this, motion, revision = problem->revision()] { emit timed({motion, revision}); };
    } catch (const std::exception& error) {
      return [this, message = QString::fromUtf8(error.what())] { emit failed(message); };
    }
  });
}

}  // namespace handway::gui
