#include "handway/planning/core/planning_problem.h"

#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/limit_violation.h"
#include "handway/geometric/robot/normalised_joints.h"
#include "handway/planning/core/select_joints.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace handway::planning {
namespace {

using geometric::InputError;

// Largest difference between start and goal of a joint that does not move, rad or m.
constexpr double kAgreement = 1e-6;

// Largest excess over a limit that counts as rounding in files, which write π as 3.14159 or
// 3.14159265, rad or m.
constexpr double kAtLimit = 1e-5;

// Sets joints that exceed a limit by at most kAtLimit to the limit. Adds a warning unless the
// excess is within the tolerance of a limit.
void clamp_at_limits(const geometric::RobotModel& model, const char* which, Configuration& q,
                     std::vector<std::string>& warnings) {
  if (q.size() != model.variable_count()) {
    return;
  }
  const Configuration inside = model.clamped(q);
  for (Eigen::Index v = 0; v < q.size(); ++v) {
    const double beyond = std::abs(q[v] - inside[v]);
    if (beyond == 0.0 || !(beyond <= kAtLimit)) {
      continue;
    }
    if (beyond > geometric::limit_tolerance(inside[v])) {
      warnings.push_back(fmt::format("The {} has joint {} at {:.7g}; its limit {:.7g} is taken.",
                                     which, model.variable(static_cast<int>(v)).name, q[v],
                                     inside[v]));
    }
    q[v] = inside[v];
  }
}

void set_ends(const geometric::Scene& scene, GoalNeed need, PlanningProblem& problem) {
  const geometric::RobotInstance& robot = scene.robots.front();
  problem.start = scene.start.value_or(robot.configuration);
  clamp_at_limits(*robot.model, "start", problem.start, problem.warnings);
  if (!scene.goal_poses.empty()) {
    return;
  }
  problem.has_goal = scene.goal.has_value();
  if (!problem.has_goal && need == GoalNeed::kOptional) {
    problem.goal = problem.start;
    return;
  }
  if (!problem.has_goal) {
    throw InputError({scene.file.string(), "goal", "nothing", "a configuration, or a goal_pose",
                      "Planning needs a goal in the scene"});
  }
  problem.goal = robot.model->nearest_equivalent(problem.start, *scene.goal);
  clamp_at_limits(*robot.model, "goal", problem.goal, problem.warnings);
}

// Adds a warning for each fixed joint beyond its limits at the start: it can't move back, and the
// path may keep it there.
void warn_of_fixed_joints(PlanningProblem& problem) {
  if (!geometric::configuration_fault(problem.model(), problem.start).empty()) {
    return;
  }
  for (const geometric::LimitViolation& violation :
       limit_violations(problem.model(), problem.start)) {
    const std::string& name = violation.leader.empty() ? violation.joint : violation.leader;
    const std::optional<int> variable = problem.model().find_variable(name);
    if (variable && std::ranges::binary_search(problem.joints.fixed, *variable)) {
      problem.warnings.push_back(fmt::format(
          "The start has {}. It is not in the group and stays there.", to_string(violation)));
    }
  }
}

// Sets the goal, or solves the goal poses. @pre problem has its scene and checker.
void solve_goals(PlanningProblem& problem) {
  if (problem.scene->goal_poses.empty()) {
    problem.set_goal(std::move(problem.goal));
    return;
  }
  PoseGoalSolutions solved = solve_pose_goals(*problem.scene, *problem.checker, problem.start);
  problem.goal = std::move(solved.nearest);
  problem.goals = std::move(solved.candidates);
  problem.goal_fault = std::move(solved.fault);
}

// Assembles a problem. @param checker, motion null: made from `world`.
PlanningProblem assembled(std::shared_ptr<const geometric::Scene> scene,
                          std::shared_ptr<const sampling::PmdBasis> basis,
                          const std::shared_ptr<const geometric::CollisionWorld>& world,
                          std::shared_ptr<const geometric::CollisionChecker> checker,
                          std::shared_ptr<const geometric::MotionBound> motion,
                          const geometric::Preparation& preparation, GoalNeed need) {
  PlanningProblem problem;
  problem.joints = select_joints(*scene, basis.get());
  problem.hand = geometric::HandStructure::of(*scene->robots.front().model, problem.joints.arm,
                                              problem.joints.hand);
  problem.basis = problem.joints.moves_whole_hand ? std::move(basis) : nullptr;
  set_ends(*scene, need, problem);
  problem.scene = std::move(scene);
  warn_of_fixed_joints(problem);
  problem.checker = checker ? std::move(checker)
                            : geometric::make_collision_checker(
                                  world, geometric::CheckerKind::kFast, preparation);
  solve_goals(problem);
  problem.motion =
      motion ? std::move(motion) : std::make_shared<const geometric::MotionBound>(*world);
  return problem;
}

}  // namespace

void PlanningProblem::set_goal(Configuration q) {
  goal = std::move(q);
  goals.clear();
  goal_fault.clear();
  // A fixed joint whose goal differs from the start by rounding only does not move.
  for (Eigen::Index v = 0; v < std::min(goal.size(), start.size()); ++v) {
    const bool moves = std::ranges::binary_search(joints.moving, static_cast<int>(v));
    if (!moves && std::abs(goal[v] - start[v]) <= kAgreement) {
      goal[v] = start[v];
    }
  }
}

std::string group_fault(const PlanningProblem& problem) {
  std::vector<std::string> joints;
  for (int v = 0; v < std::min(problem.goal.size(), problem.start.size()); ++v) {
    if (problem.goal[v] != problem.start[v] &&
        !std::ranges::binary_search(problem.joints.moving, v)) {
      joints.push_back(problem.model().variable(v).name);
    }
  }
  if (joints.empty()) {
    return "";
  }
  return fmt::format(
      "The goal moves {}{}, which the group ({}) leaves at the start. Add {} to the group, or give "
      "the goal the start's value{}.",
      joints.front(),
      joints.size() == 1
          ? ""
          : fmt::format(" and {} other joint{}", joints.size() - 1, joints.size() == 2 ? "" : "s"),
      fmt::join(problem.scene->group, ", "), joints.size() == 1 ? "it" : "them",
      joints.size() == 1 ? "" : "s");
}

geometric::JointIndices PlanningProblem::planned_joints() const {
  return joints.planned(start, goal);
}

PlanningProblem make_problem(std::shared_ptr<const geometric::Scene> scene,
                             std::shared_ptr<const sampling::PmdBasis> basis,
                             const geometric::Preparation& preparation, GoalNeed need) {
  geometric::end_if_stopped(preparation.stop);
  const auto world = std::make_shared<const geometric::CollisionWorld>(*scene);
  return assembled(std::move(scene), std::move(basis), world, nullptr, nullptr, preparation, need);
}

PlanningProblem updated_problem(const PlanningProblem& before,
                                std::shared_ptr<const geometric::Scene> scene,
                                std::shared_ptr<const sampling::PmdBasis> basis,
                                const geometric::Preparation& preparation) {
  const auto difference = geometric::scene_difference(*before.scene, *scene);
  if (!difference || !difference->keeps_order) {
    return make_problem(std::move(scene), std::move(basis), preparation);
  }
  if (difference->empty()) {
    return assembled(std::move(scene), std::move(basis), before.checker->shared_world(),
                     before.checker, before.motion, preparation, GoalNeed::kRequired);
  }
  geometric::CollisionWorld world = before.checker->world();
  for (const geometric::ObjectChange& change : difference->changes) {
    world = world.with_change(change);
  }
  const auto changed =
      std::make_shared<const geometric::CollisionWorld>(world.with_constraints_of(*scene));
  const bool only_moved = !difference->other_constraints &&
                          std::ranges::all_of(difference->changes, [](const auto& change) {
                            return change.kind == geometric::ObjectChange::Kind::kMoved;
                          });
  return assembled(std::move(scene), std::move(basis), changed, nullptr,
                   only_moved ? before.motion : nullptr, preparation, GoalNeed::kRequired);
}

double normalised_distance(const geometric::RobotModel& model, const Configuration& a,
                           const Configuration& b) {
  return (geometric::normalised(model, a) - geometric::normalised(model, b)).norm();
}

double arm_progress(const PlanningProblem& problem, const Configuration& q) {
  double length = 0.0;
  double along = 0.0;
  for (const int joint : problem.joints.arm) {
    const double motion = problem.goal[joint] - problem.start[joint];
    length += motion * motion;
    along += motion * (q[joint] - problem.start[joint]);
  }
  return length == 0.0 ? 0.0 : std::clamp(along / length, 0.0, 1.0);
}

}  // namespace handway::planning
