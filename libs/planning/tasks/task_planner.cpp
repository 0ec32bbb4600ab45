#include "handway/geometric/collision/volumes/preparation.h"
#include "handway/planning/tasks/task.h"
#include "step_candidates.h"
#include "task_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace handway::planning {
namespace {

// Lets a motion that stays in one place last for a time (s), rounded up to whole periods.
void rest_for(double time, double period, TimedPath& timed) {
  constexpr double kRounding = 1e-6;  // of a period
  const double duration = period * std::ceil(time / period - kRounding);
  Trajectory& trajectory = timed.motion.trajectory;
  trajectory.points.resize(1);
  if (duration > 0.0) {
    trajectory.points.push_back(trajectory.points.front());
    trajectory.points.back().time = duration;
  }
  timed.motion.waypoint_times = {0.0, duration};
  timed.preflight.points = trajectory.points.size();
  timed.preflight.duration = duration;
  timed.least_duration = duration;
  if (timed.preflight.shortfall) {
    timed.preflight.shortfall->place = 0.0;
  }
}

/// Makes the candidates of a step.
struct MakeCandidates {
  std::size_t step;
  const TaskState& begin;
  const TaskContext& context;

  std::unique_ptr<StepCandidates> operator()(const PickStep& pick) const {
    return pick_candidates(pick, step, begin, context);
  }
  std::unique_ptr<StepCandidates> operator()(const PlaceStep& place) const {
    return place_candidates(place, step, begin, context);
  }
  std::unique_ptr<StepCandidates> operator()(const MoveStep& move) const {
    return move_candidates(move, step, begin, context);
  }
  std::unique_ptr<StepCandidates> operator()(const PoseStep& move) const {
    return pose_candidates(move, step, begin, context);
  }
  std::unique_ptr<StepCandidates> operator()(const LineStep& line) const {
    return line_candidates(line, step, begin, context);
  }
  std::unique_ptr<StepCandidates> operator()(const WaitStep& wait) const {
    return wait_candidates(wait, step, begin);
  }
  std::unique_ptr<StepCandidates> operator()(const OutputStep& /*output*/) const {
    return output_candidates(step, begin);
  }
  std::unique_ptr<StepCandidates> operator()(const FirstOfStep& /*step*/) const { return nullptr; }
};

/// Finds a candidate for each step, and the motions between them, depth first.
class TaskSearch {
 public:
  TaskSearch(const Task& task, Planner& planner, const TaskContext& context)
      : task_(task), planner_(planner), context_(context) {}

  /// Returns whether these steps are possible, one after another. @param begin before the first.
  bool solve(std::span<const std::size_t> steps, const TaskState& begin) {
    if (steps.empty()) {
      return plan_free_stages();
    }
    const std::size_t step = steps.front();
    if (std::holds_alternative<FirstOfStep>(task_[step])) {
      return solve_first_of(steps, begin);
    }
    const std::unique_ptr<StepCandidates> candidates = candidates_of(step, begin);
    while (std::optional<StepCandidate> candidate = candidates->next()) {
      const std::size_t before = stages_.size();
      stages_.insert(stages_.end(), candidate->stages.begin(), candidate->stages.end());
      if (solve(steps.subspan(1), candidate->end)) {
        return true;
      }
      stages_.resize(before);
      if (!goes_on_after(step)) {
        return false;
      }
    }
    return false;
  }

  [[nodiscard]] const std::vector<std::shared_ptr<StageDraft>>& stages() const { return stages_; }

 private:
  // Tries the alternatives of the first step, each with all steps after it.
  bool solve_first_of(std::span<const std::size_t> steps, const TaskState& begin) {
    for (Steps alternative : alternatives_of(task_, steps.front())) {
      alternative.insert(alternative.end(), steps.begin() + 1, steps.end());
      if (solve(alternative, begin)) {
        return true;
      }
      if (!goes_on_after(steps.front())) {
        return false;
      }
    }
    return false;
  }

  // Returns whether another candidate of a step may help: not if a motion before it has failed.
  bool goes_on_after(std::size_t step) {
    if (failed_step_ < step) {
      return false;
    }
    failed_step_ = task_.size();
    return true;
  }

  [[nodiscard]] std::unique_ptr<StepCandidates> candidates_of(std::size_t step,
                                                              const TaskState& begin) const {
    return std::visit(MakeCandidates{step, begin, context_}, task_[step]);
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

// The state for the scenes of stages: programs are about the scene as it was before.
SceneState without_programs(const SceneState& state) {
  SceneState result = state;
  auto scene = std::make_shared<geometric::Scene>(*state.scene);
  scene->programs.clear();
  result.scene = std::move(scene);
  return result;
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
    case StageKind::kLine:
      return "line";
    case StageKind::kWait:
      return "wait";
    case StageKind::kOutput:
      return "output";
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

GraspsByObject grasps_of(const Task& task, const TaskPlan& plan) {
  GraspsByObject grasps;
  for (const TaskStage& stage : plan.stages) {
    if (stage.grasp) {
      grasps[std::get<PickStep>(task[stage.step]).object].push_back(*stage.grasp);
    }
  }
  return grasps;
}

std::string to_string(const TaskStep& step) {
  if (const auto* move = std::get_if<MoveStep>(&step)) {
    return "move to " + move->name;
  }
  if (const auto* first_of = std::get_if<FirstOfStep>(&step)) {
    return first_of->words;
  }
  return std::visit(
      [](const auto& one) -> std::string {
        if constexpr (requires { geometric::ProgramStep(one); }) {
          return geometric::to_string(one);
        }
        return "";
      },
      step);
}

bool is_at_rest(StageKind kind) { return kind == StageKind::kWait || kind == StageKind::kOutput; }

TimedPath time_stage(const TaskStage& stage, const std::string& name,
                     const TimingOptions& options) {
  TimedPath timed = time_path(make_problem(stage.state.scene, stage.state.basis, {options.stop}),
                              stage.path, name, options);
  if (is_at_rest(stage.kind) && timed.cleared()) {
    rest_for(stage.rest, options.period, timed);
  }
  return timed;
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
      plan.solved = search.solve(steps_of(task), {world, q});
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
