#include "task_world.h"

#include "handway/geometric/collision/volumes/preparation.h"
#include "handway/geometric/robot/limit_violation.h"
#include "handway/planning/paths/path_check.h"

#include <algorithm>
#include <utility>

namespace handway::planning {

using geometric::Scene;

TaskWorld TaskWorld::of(const SceneState& state, const Configuration& q,
                        const std::stop_token& stop) {
  Scene scene = *state.scene;
  scene.start = q;
  scene.goal.reset();
  scene.goal_poses.clear();
  TaskWorld world{state, nullptr};
  world.state.scene = std::make_shared<const Scene>(std::move(scene));
  world.problem = std::make_shared<const PlanningProblem>(
      make_problem(world.state.scene, state.basis, {stop}, GoalNeed::kOptional));
  return world;
}

std::optional<std::string> TaskWorld::conflict(std::span<const Configuration> waypoints,
                                               const std::stop_token& stop) const {
  for (const Configuration& q : waypoints) {
    if (std::string fault = geometric::configuration_fault(problem->model(), q); !fault.empty()) {
      return fault;
    }
  }
  PathConflictSearch search(*problem);
  const auto found = search.run(waypoints, [&stop] { return stop.stop_requested(); });
  geometric::end_if_stopped(stop);
  return found ? std::optional(found->text) : std::nullopt;
}

PlanningProblem TaskWorld::motion(const Configuration& from, const Configuration& to) const {
  return updated_problem(*problem, with_ends(state, from, to).scene, state.basis);
}

SceneState with_ends(const SceneState& state, const Configuration& from, const Configuration& to) {
  Scene scene = *state.scene;
  scene.start = from;
  scene.goal = to;
  scene.goal_poses.clear();
  SceneState next = state;
  next.scene = std::make_shared<const Scene>(std::move(scene));
  return next;
}

SceneState with_contacts(const SceneState& state, const std::vector<std::string>& links,
                         const std::string& object) {
  Scene scene = *state.scene;
  for (const std::string& link : links) {
    scene.allowed_collisions[std::minmax(link, object)] = true;
  }
  SceneState next = state;
  next.scene = std::make_shared<const Scene>(std::move(scene));
  return next;
}

void TrialLog::fail(std::size_t step, StageKind kind, const std::string& reason,
                    const Configuration& q) {
  StageTrials& trials = entry(step, kind);
  ++trials.tried;
  ++trials.failed;
  if (trials.reason.empty()) {
    trials.reason = reason;
    trials.q = q;
  }
}

StageTrials& TrialLog::entry(std::size_t step, StageKind kind) {
  const auto found = std::ranges::find_if(trials_, [&](const StageTrials& trials) {
    return trials.step == step && trials.kind == kind;
  });
  return found == trials_.end() ? trials_.emplace_back(StageTrials{step, kind}) : *found;
}

}  // namespace handway::planning
