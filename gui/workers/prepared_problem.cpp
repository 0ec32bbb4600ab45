#include "workers/prepared_problem.h"

#include "workers/problem_update.h"

#include <chrono>
#include <utility>

namespace handway::gui {
namespace {

constexpr std::chrono::milliseconds kLookEvery(20);

// With a start and a goal.
std::shared_ptr<const geometric::Scene> with_query(std::shared_ptr<const geometric::Scene> scene) {
  if ((scene->start && scene->goal) || scene->robots.empty()) {
    return scene;
  }
  auto complete = std::make_shared<geometric::Scene>(*scene);
  for (auto* end : {&complete->start, &complete->goal}) {
    if (!*end) {
      *end = complete->robots.front().configuration;
    }
  }
  return complete;
}

}  // namespace

PreparedProblem::PreparedProblem(planning::LoadedScene loaded, const planning::Revision& revision,
                                 BackgroundThreads& threads, const PreparedProblem* before)
    : revision_(revision) {
  auto promise = std::make_shared<std::promise<Problem>>();
  problem_ = promise->get_future().share();
  threads.run([promise = std::move(promise), loaded = std::move(loaded),
               known = before ? before->if_ready() : nullptr] {
    try {
      const planning::LoadedScene complete{with_query(loaded.scene), loaded.basis};
      promise->set_value(std::make_shared<const planning::PlanningProblem>(
          known ? updated_problem(*known, complete)
                : planning::make_problem(complete.scene, complete.basis)));
    } catch (...) {
      promise->set_exception(std::current_exception());
    }
  });
}

PreparedProblem::Problem PreparedProblem::wait(const std::stop_token& stop) const {
  while (problem_.wait_for(kLookEvery) != std::future_status::ready) {
    if (stop.stop_requested()) {
      return nullptr;
    }
  }
  return problem_.get();
}

PreparedProblem::Problem PreparedProblem::if_ready() const {
  if (problem_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    return nullptr;
  }
  try {
    return problem_.get();
  } catch (const std::exception&) {  // told to those who wait for it
    return nullptr;
  }
}

}  // namespace handway::gui
