#include "handway/geometric/collision/volumes/preparation.h"
#include "handway/geometric/io/input_error.h"
#include "handway/planning/edits/scene_edits.h"
#include "handway/planning/tasks/task.h"
#include "step_candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

/// Finds a candidate for each step, and the motions between them, depth first.
class TaskSearch {
 public:
  TaskSearch(const Task& task, Planner& planner, const TaskContext& context)
      : task_(task), planner_(planner), context_(context) {}

  /// Returns whether the steps from `step` on are possible.
  bool solve(std::size_t step, const TaskState& begin) {
    if (step == task_.size()) {
      return plan_free_stages();
    }
    const std::unique_ptr<StepCandidates> candidates = candidates_of(step, begin);
    while (std::optional<StepCandidate> candidate = candidates->next()) {
      const std::size_t before = stages_.size();
      stages_.insert(stages_.end(), candidate->stages.begin(), candidate->stages.end());
      if (solve(step + 1, candidate->end)) {
        return true;
      }
      stages_.resize(before);
      if (failed_step_ < step) {
        return false;  // another candidate of this step changes nothing
      }
      failed_step_ = task_.size();
    }
    return false;
  }

  [[nodiscard]] const std::vector<std::shared_ptr<StageDraft>>& stages() const { return stages_; }

 private:
  [[nodiscard]] std::unique_ptr<StepCandidates> candidates_of(std::size_t step,
                                                              const TaskState& begin) const {
    const auto make = [&](const auto& one) -> std::unique_ptr<StepCandidates> {
      using Step = std::decay_t<decltype(one)>;
      if constexpr (std::is_same_v<Step, PickStep>) {
        return pick_candidates(one, step, begin, context_);
      } else if constexpr (std::is_same_v<Step, PlaceStep>) {
        return place_candidates(one, step, begin, context_);
      } else {
        return move_candidates(one, step, begin, context_);
      }
    };
    return std::visit(make, task_[step]);
  }

  // Plans those stages that are not planned yet, in their order. Sets the step of one that fails.
  bool plan_free_stages() {
    for (const std::shared_ptr<StageDraft>& draft : stages_) {
      if (!draft->is_planned) {
        plan(*draft);
      }
      if (draft->stage.path.empty()) {
        failed_step_ = draft->stage.step;
        return false;
      }
    }
    return true;
  }

  void plan(StageDraft& draft) {
    draft.is_planned = true;
    PlanRequest request;
    request.seed = context_.options.seed;
    request.threads = context_.options.threads;
    request.time_limit_s = context_.options.motion_time_s;
    const PlanningProblem problem = draft.world.motion(draft.from, draft.to);
    const PlanResult result = planner_.plan(problem, request, context_.stop);
    geometric::end_if_stopped(context_.stop);
    if (!result.solved()) {
      context_.log.fail(draft.stage.step, draft.stage.kind, result.reason, draft.to);
      return;
    }
    context_.log.succeed(draft.stage.step, draft.stage.kind);
    draft.stage.path = result.path;
    draft.stage.state = with_ends(draft.world.state, draft.from, draft.to);
  }

  const Task& task_;
  Planner& planner_;
  const TaskContext& context_;
  std::vector<std::shared_ptr<StageDraft>> stages_;
  std::size_t failed_step_ = task_.size();  ///< The step of the motion that failed last.
};

// The stage in which all candidates of a step failed, or else that in which most failed. A reach
// and a retreat need not be straight.
const StageTrials* worst_of(const std::vector<StageTrials>& trials) {
  const StageTrials* worst = nullptr;
  for (const StageTrials& one : trials) {
    if (one.kind == StageKind::kReach || one.kind == StageKind::kRetreat || one.failed == 0) {
      continue;
    }
    if (one.failed == one.tried) {
      return &one;
    }
    worst = worst == nullptr || one.failed > worst->failed ? &one : worst;
  }
  return worst;
}

std::string failure(const Task& task, const std::vector<StageTrials>& trials) {
  const StageTrials* worst = worst_of(trials);
  if (worst == nullptr) {
    return "The task has no solution.";
  }
  return fmt::format("Step {}, {}: in the stage \"{}\" {} of {} candidates failed. The first: {}{}",
                     worst->step + 1, to_string(task[worst->step]), to_string(worst->kind),
                     worst->failed, worst->tried, worst->reason,
                     worst->reason.ends_with('.') ? "" : ".");
}

// Refuses supports that are not there, or move with a link or with the carried object.
void need_support(const geometric::Scene& scene, const std::string& support,
                  const std::string& carried) {
  const geometric::SceneObject& object = need_object(scene, support);
  if (support == carried) {
    throw geometric::InputError(
        {"task", "place", "the object itself, \"" + support + "\"", "another object", ""});
  }
  if (object.attachment) {
    throw geometric::InputError({"task", "place",
                                 "\"" + support + "\", which is attached to a link",
                                 "an object that stands in the world", ""});
  }
}

// The state for the scenes of stages: programs are about the scene as it was before.
SceneState without_programs(const SceneState& state) {
  SceneState result = state;
  auto scene = std::make_shared<geometric::Scene>(*state.scene);
  scene->programs.clear();
  result.scene = std::move(scene);
  return result;
}

// Refuses steps that can not follow each other, and names that the scene lacks.
void check_steps(const geometric::Scene& scene, const Task& task) {
  if (scene.robots.empty()) {
    throw geometric::InputError({source_of(scene), "robots", "none", "a robot", ""});
  }
  if (task.empty()) {
    throw geometric::InputError({"task", "", "no steps", "at least one", ""});
  }
  std::string carried;
  for (const TaskStep& step : task) {
    if (const auto* pick = std::get_if<PickStep>(&step)) {
      need_object(scene, pick->object);
      if (!carried.empty()) {
        throw geometric::InputError({"task", to_string(step), "a hand that carries " + carried,
                                     "an empty hand", "Place what it carries first"});
      }
      carried = pick->object;
    } else if (const auto* place = std::get_if<PlaceStep>(&step)) {
      if (!place->support.empty()) {
        need_support(scene, place->support, carried);
      }
      if (carried.empty()) {
        throw geometric::InputError({"task", to_string(step), "an empty hand",
                                     "an object that a step before has picked",
                                     "Pick an object first"});
      }
      carried.clear();
    }
  }
}

}  // namespace

const char* to_string(StageKind kind) {
  switch (kind) {
    case StageKind::kMove:
      return "move";
    case StageKind::kApproach:
      return "approach";
    case StageKind::kReach:
      return "reach";
    case StageKind::kClose:
      return "close";
    case StageKind::kLift:
      return "lift";
    case StageKind::kCarry:
      return "carry";
    case StageKind::kLower:
      return "lower";
    case StageKind::kOpen:
      return "open";
    case StageKind::kRetreat:
      return "retreat";
  }
  return "";
}

std::vector<std::string> picked_objects(const Task& task) {
  std::vector<std::string> objects;
  for (const TaskStep& step : task) {
    const auto* pick = std::get_if<PickStep>(&step);
    if (pick && std::ranges::count(objects, pick->object) == 0) {
      objects.push_back(pick->object);
    }
  }
  return objects;
}

std::string to_string(const TaskStep& step) {
  if (const auto* pick = std::get_if<PickStep>(&step)) {
    return "pick " + pick->object;
  }
  if (const auto* place = std::get_if<PlaceStep>(&step)) {
    return place->support.empty() ? "place" : "place on " + place->support;
  }
  return "move to " + std::get<MoveStep>(step).name;
}

TimedPath time_stage(const TaskStage& stage, const std::string& name,
                     const TimingOptions& options) {
  return time_path(make_problem(stage.state.scene, stage.state.basis, {options.stop}), stage.path,
                   name, options);
}

std::vector<geometric::BoundParameter> parameters_of(TaskOptions& options) {
  std::vector<geometric::BoundParameter> list = {
      {"motion_time", "Time of a motion", "s", "Time before a motion of the planner is given up",
       &options.motion_time_s, 1e-3, 1e6},
      {"places", "Places", "", "Largest number of places to try for each grasp", &options.places, 1,
       1e5}};
  std::vector<geometric::BoundParameter> of_grasps = parameters_of(options.grasps);
  of_grasps.front().key = "grasps";
  std::ranges::move(of_grasps, std::back_inserter(list));
  return list;
}

TaskPlan plan_task(const SceneState& state, const Task& task, Planner& planner,
                   const TaskOptions& options, const std::stop_token& stop) {
  const auto begin = std::chrono::steady_clock::now();
  check_steps(*state.scene, task);
  TrialLog log;
  const TaskContext context{options, stop, log};
  TaskSearch search(task, planner, context);
  TaskPlan plan;
  try {
    const Configuration q = state.scene->start.value_or(state.scene->robots.front().configuration);
    const TaskWorld world = TaskWorld::of(without_programs(state), q, stop);
    if (const auto fault = world.conflict(std::vector{q}, stop)) {
      plan.start_is_valid = false;
      plan.reason = fmt::format("The start is not valid: {}.", *fault);
    } else {
      plan.solved = search.solve(0, {world, q});
      plan.reason = plan.solved ? "" : failure(task, log.trials());
    }
  } catch (const geometric::PreparationStopped&) {
    plan.reason = "The search was interrupted.";
  }
  if (plan.solved) {
    for (const std::shared_ptr<StageDraft>& draft : search.stages()) {
      plan.stages.push_back(draft->stage);
    }
  }
  plan.trials = log.trials();
  plan.time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return plan;
}

}  // namespace handway::planning
