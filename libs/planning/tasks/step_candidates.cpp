#include "step_candidates.h"

#include "handway/planning/core/pose_goals.h"

#include <algorithm>
#include <utility>

namespace handway::planning {
namespace {

/// Ways that are all known at first.
class KnownCandidates : public StepCandidates {
 public:
  explicit KnownCandidates(std::vector<StepCandidate> candidates)
      : candidates_(std::move(candidates)) {}

  std::optional<StepCandidate> next() override {
    return next_ < candidates_.size() ? std::optional(std::move(candidates_[next_++]))
                                      : std::nullopt;
  }

 private:
  std::vector<StepCandidate> candidates_;
  std::size_t next_ = 0;
};

std::string carried_in(const TaskState& state) {
  return state.held ? state.held->name : std::string();
}

// A motion of the planner to `q`; while the hand carries an object its joints stay.
StepCandidate motion_to(const Configuration& q, std::size_t step, const TaskState& begin) {
  TaskState end = begin;
  end.q = begin.held ? begin.held->hand->with_hand(q, begin.q) : q;
  const StageKind kind = begin.held ? StageKind::kCarry : StageKind::kMove;
  return {{free_stage(kind, step, begin.world, begin.q, end.q, carried_in(begin))}, end};
}

// A stage in which nothing moves. @param duration s.
std::unique_ptr<StepCandidates> rest_candidates(StageKind kind, std::size_t step,
                                                const TaskState& begin, double duration) {
  StepCandidate only{
      {fixed_stage(kind, step, begin.world, Path{{begin.q, begin.q}}, carried_in(begin))}, begin};
  only.stages.front()->stage.rest = duration;
  return std::make_unique<KnownCandidates>(std::vector{std::move(only)});
}

// The scene in which a goal of a step is to be reached from the state.
geometric::Scene scene_with_goal(const TaskState& begin, geometric::PoseGoal goal) {
  geometric::Scene scene = *begin.world.state.scene;
  goal.X_WG =
      geometric::standing_pose(scene, goal.reference).value_or(geometric::Pose::Identity()) *
      goal.X_WG;
  if (const geometric::NamedFrame* tool = geometric::find_frame(scene, goal.tool)) {
    goal.X_LT = tool->X_PF;
  }
  scene.goal.reset();
  scene.goal_poses = {std::move(goal)};
  return scene;
}

}  // namespace

std::shared_ptr<StageDraft> free_stage(StageKind kind, std::size_t step, const TaskWorld& world,
                                       const Configuration& from, const Configuration& to,
                                       const std::string& carried) {
  auto draft = std::make_shared<StageDraft>();
  draft->stage.kind = kind;
  draft->stage.step = step;
  draft->stage.carried = carried;
  draft->world = world;
  draft->from = from;
  draft->to = to;
  return draft;
}

std::shared_ptr<StageDraft> fixed_stage(StageKind kind, std::size_t step, const TaskWorld& world,
                                        Path path, const std::string& carried, double deviation) {
  auto draft =
      free_stage(kind, step, world, path.waypoints.front(), path.waypoints.back(), carried);
  draft->stage.path = std::move(path);
  draft->stage.state = with_ends(world.state, draft->from, draft->to);
  draft->stage.deviation = deviation;
  draft->is_planned = true;
  return draft;
}

PalmLine vertical_line(const GraspingHand& hand, const TaskWorld& world, const Configuration& q,
                       double height, bool downwards, const std::stop_token& stop) {
  PalmLine first;
  for (const double share : {1.0, 0.5, 0.25}) {
    PalmLine line = hand.line(q, share * height * Eigen::Vector3d::UnitZ());
    if (line.fault.empty()) {
      if (downwards) {
        std::ranges::reverse(line.path.waypoints);
      }
      line.fault = world.conflict(line.path.waypoints, stop).value_or("");
    }
    if (line.fault.empty()) {
      return line;
    }
    first = first.fault.empty() ? std::move(line) : std::move(first);
  }
  return first;
}

std::unique_ptr<StepCandidates> move_candidates(const MoveStep& move, std::size_t step,
                                                const TaskState& begin,
                                                const TaskContext& /*context*/) {
  return std::make_unique<KnownCandidates>(std::vector{motion_to(move.q, step, begin)});
}

std::unique_ptr<StepCandidates> pose_candidates(const PoseStep& move, std::size_t step,
                                                const TaskState& begin,
                                                const TaskContext& context) {
  const StageKind kind = begin.held ? StageKind::kCarry : StageKind::kMove;
  const geometric::Scene scene = scene_with_goal(begin, move.goal);
  const PoseGoalSolutions found = solve_pose_goals(scene, *begin.world.problem->checker, begin.q);
  std::vector<StepCandidate> candidates;
  for (const GoalCandidate& one : found.candidates) {
    StepCandidate candidate = motion_to(one.q, step, begin);
    const std::string miss = pose_goal_miss(scene, candidate.end.q);
    if (miss.empty()) {
      candidates.push_back(std::move(candidate));
    } else {
      context.log.fail(step, kind, "With the fingers that hold the object, the robot " + miss,
                       candidate.end.q);
    }
  }
  if (found.candidates.empty()) {
    context.log.fail(step, kind, found.fault, found.nearest);
  }
  return std::make_unique<KnownCandidates>(std::move(candidates));
}

std::unique_ptr<StepCandidates> line_candidates(const LineStep& line, std::size_t step,
                                                const TaskState& begin,
                                                const TaskContext& context) {
  const PlanningProblem& problem = *begin.world.problem;
  const std::shared_ptr<const GraspingHand> hand =
      begin.held ? begin.held->hand
                 : std::make_shared<const GraspingHand>(problem, problem.hand.palm);
  const geometric::Pose axes = line.reference == geometric::kPalmAxes
                                   ? hand->palm_pose(begin.q)
                                   : geometric::standing_pose(*problem.scene, line.reference)
                                         .value_or(geometric::Pose::Identity());
  PalmLine way = hand->line(begin.q, axes.linear() * line.shift);
  if (way.fault.empty()) {
    way.fault = begin.world.conflict(way.path.waypoints, context.stop).value_or("");
  }
  if (!way.fault.empty()) {
    context.log.fail(step, StageKind::kLine, way.fault, begin.q);
    return std::make_unique<KnownCandidates>(std::vector<StepCandidate>());
  }
  context.log.succeed(step, StageKind::kLine);
  TaskState end = begin;
  end.q = way.path.waypoints.back();
  StepCandidate only{{fixed_stage(StageKind::kLine, step, begin.world, std::move(way.path),
                                  carried_in(begin), way.deviation)},
                     std::move(end)};
  return std::make_unique<KnownCandidates>(std::vector{std::move(only)});
}

std::unique_ptr<StepCandidates> wait_candidates(const WaitStep& wait, std::size_t step,
                                                const TaskState& begin) {
  return rest_candidates(StageKind::kWait, step, begin, wait.duration);
}

std::unique_ptr<StepCandidates> output_candidates(std::size_t step, const TaskState& begin) {
  return rest_candidates(StageKind::kOutput, step, begin, 0.0);
}

}  // namespace handway::planning
