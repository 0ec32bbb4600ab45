#include "handway/planning/core/planning_problem.h"

#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/inverse_kinematics.h"
#include "handway/geometric/robot/limit_violation.h"
#include "handway/geometric/robot/normalised_joints.h"
#include "handway/geometric/setup/moving_group.h"
#include "handway/planning/core/carried_objects.h"
#include "handway/planning/core/limbs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
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
  const std::vector<int> fixed = fixed_variables(problem);
  for (const geometric::LimitViolation& violation :
       limit_violations(problem.model(), problem.start)) {
    const std::string& name = violation.leader.empty() ? violation.joint : violation.leader;
    const std::optional<int> variable = problem.model().find_variable(name);
    if (variable && std::ranges::binary_search(fixed, *variable)) {
      problem.warnings.push_back(fmt::format(
          "The start has {}. It is not of the group and stays there.", to_string(violation)));
    }
  }
}

bool has_all(const std::vector<int>& moving, const std::vector<int>& variables) {
  return std::ranges::all_of(variables,
                             [&](int v) { return std::ranges::binary_search(moving, v); });
}

// Returns the variables whose goal differs from the start, and those that move the links of goal
// poses. Empty without a goal.
std::vector<int> variables_with_a_goal(const geometric::Scene& scene) {
  const geometric::RobotInstance& robot = scene.robots.front();
  std::vector<int> variables;
  for (const geometric::PoseGoal& pose : scene.goal_poses) {
    std::ranges::copy(chain_variables(*robot.model, robot.model->find_link(pose.link).value()),
                      std::back_inserter(variables));
  }
  const Configuration start = scene.start.value_or(robot.configuration);
  const Configuration goal = robot.model->nearest_equivalent(start, scene.goal.value_or(start));
  for (int v = 0; v < std::min(start.size(), goal.size()); ++v) {
    if (std::abs(goal[v] - start[v]) > kAgreement) {
      variables.push_back(v);
    }
  }
  return variables;
}

// Sets the moving variables and those of arm and hand, and the basis if the whole hand may move.
void set_joints(const geometric::Scene& scene, std::shared_ptr<const sampling::PmdBasis> basis,
                PlanningProblem& problem) {
  problem.moving = geometric::moving_variables(scene);
  problem.hand = hand_variables(scene, basis.get());
  problem.basis = has_all(problem.moving, problem.hand) ? std::move(basis) : nullptr;
  std::erase_if(problem.hand,
                [&](int v) { return !std::ranges::binary_search(problem.moving, v); });
  problem.arm = arm_variables(*scene.robots.front().model, problem.hand);
  if (!scene.group.empty()) {
    problem.arm = problem.moving;
    std::erase_if(problem.arm, [&](int v) { return std::ranges::count(problem.hand, v) > 0; });
  }
  const std::vector<int> resting = resting_variables(scene);
  const auto rests = [&](int v) { return std::ranges::binary_search(resting, v); };
  std::erase_if(problem.hand, rests);
  std::erase_if(problem.arm, rests);
  const std::vector<int> holding = holding_variables(scene);
  const auto holds = [&](int v) { return std::ranges::binary_search(holding, v); };
  if (std::erase_if(problem.hand, holds) > 0) {
    problem.basis = nullptr;  // its directions move the whole hand
  }
  std::erase_if(problem.arm, holds);
}

// Returns the variable of a joint of a basis. If several parts have such a joint, returns that of
// the part that moves.
std::optional<int> hand_variable(const geometric::RobotModel& model, const std::vector<int>& moving,
                                 const std::string& joint) {
  std::vector<int> named = moving;
  std::erase_if(named, [&](int v) {
    const std::string& name = model.variable(v).name;
    return name != joint && !name.ends_with('/' + joint);
  });
  return named.size() == 1 ? std::optional(named.front())
                           : geometric::find_variable_of_part(model, joint);
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
  set_joints(*scene, std::move(basis), problem);
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
    const bool moves = std::ranges::binary_search(moving, static_cast<int>(v));
    if (!moves && std::abs(goal[v] - start[v]) <= kAgreement) {
      goal[v] = start[v];
    }
  }
}

std::vector<int> fixed_variables(const PlanningProblem& problem) {
  std::vector<int> fixed(static_cast<std::size_t>(problem.model().variable_count()));
  std::iota(fixed.begin(), fixed.end(), 0);
  std::erase_if(fixed, [&](int v) { return std::ranges::binary_search(problem.moving, v); });
  return fixed;
}

std::string group_fault(const PlanningProblem& problem) {
  std::vector<std::string> joints;
  for (int v = 0; v < std::min(problem.goal.size(), problem.start.size()); ++v) {
    if (problem.goal[v] != problem.start[v] && !std::ranges::binary_search(problem.moving, v)) {
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

std::vector<int> planned_variables(const PlanningProblem& problem) {
  std::vector<int> planned = problem.moving;
  std::erase_if(planned, [&](int v) {
    return std::ranges::count(problem.arm, v) + std::ranges::count(problem.hand, v) == 0 &&
           problem.start[v] == problem.goal[v];
  });
  return planned;
}

std::vector<int> resting_variables(const geometric::Scene& scene) {
  if (!scene.group.empty()) {
    return {};
  }
  const geometric::RobotModel& model = *scene.robots.front().model;
  const std::vector<int> hand = hand_variables(scene, nullptr);
  const std::vector<int> wanted = variables_with_a_goal(scene);
  const auto is_wanted = [&](int v) { return std::ranges::count(wanted, v) > 0; };
  std::vector<int> resting;
  bool any_moves = false;
  for (const Limb& limb : limbs(model, arm_variables(model, hand), hand)) {
    if (std::ranges::any_of(limb.arm, is_wanted) || std::ranges::any_of(limb.hand, is_wanted)) {
      any_moves = true;
    } else {
      std::ranges::copy(limb.arm, std::back_inserter(resting));
      std::ranges::copy(limb.hand, std::back_inserter(resting));
    }
  }
  std::ranges::sort(resting);
  return any_moves ? resting : std::vector<int>();
}

std::vector<int> hand_variables(const geometric::Scene& scene, const sampling::PmdBasis* basis) {
  const geometric::RobotModel& model = *scene.robots.front().model;
  if (!basis) {
    return model.find_group("hand").value_or(std::vector<int>{});
  }
  std::vector<int> hand;
  std::vector<int> moving = geometric::moving_variables(scene);
  const std::vector<int> resting = resting_variables(scene);
  std::erase_if(moving, [&](int v) { return std::ranges::binary_search(resting, v); });
  for (const std::string& joint : basis->joints) {
    const std::optional<int> variable = hand_variable(model, moving, joint);
    if (!variable) {
      throw InputError({scene.file.string(), "hand_basis",
                        "joint \"" + joint + "\", which robot " + model.name() + " has not",
                        "a basis for this robot's hand", "The basis is for " + basis->hand});
    }
    hand.push_back(*variable);
  }
  return hand;
}

// A group "arm" without variables, or with the hand's only, counts as missing.
std::vector<int> arm_variables(const geometric::RobotModel& model, const std::vector<int>& hand) {
  const auto is_of_hand = [&](int v) { return std::ranges::count(hand, v) > 0; };
  std::vector<int> arm = model.find_group("arm").value_or(std::vector<int>{});
  std::erase_if(arm, is_of_hand);
  if (arm.empty()) {
    arm.resize(static_cast<std::size_t>(model.variable_count()));
    std::iota(arm.begin(), arm.end(), 0);
    std::erase_if(arm, is_of_hand);
  }
  return arm;
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
  const Eigen::VectorXd motion = problem.goal(problem.arm) - problem.start(problem.arm);
  const double length = motion.squaredNorm();
  if (length == 0.0) {
    return 0.0;
  }
  return std::clamp((q(problem.arm) - problem.start(problem.arm)).dot(motion) / length, 0.0, 1.0);
}

}  // namespace handway::planning
