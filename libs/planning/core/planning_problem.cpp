#include "handway/planning/core/planning_problem.h"

#include "handway/geometric/collision/checkers/make_checker.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/normalised_joints.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace handway::planning {
namespace {

using geometric::InputError;

const Configuration& needed(const geometric::Scene& scene, const char* which,
                            const std::optional<Configuration>& q) {
  if (!q) {
    throw InputError({scene.file.string(), which, "nothing", "a configuration",
                      "Planning needs a start and a goal in the scene"});
  }
  return *q;
}

void set_ends(const geometric::Scene& scene, PlanningProblem& problem) {
  problem.start = needed(scene, "start", scene.start);
  if (!scene.goal_poses.empty()) {
    return;
  }
  problem.goal = scene.robots.front().model->nearest_equivalent(problem.start,
                                                                needed(scene, "goal", scene.goal));
}

// With the scene and the checker in place.
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

}  // namespace

std::vector<int> hand_variables(const geometric::Scene& scene, const sampling::PmdBasis* basis) {
  const geometric::RobotModel& model = *scene.robots.front().model;
  if (!basis) {
    return model.find_group("hand").value_or(std::vector<int>{});
  }
  std::vector<int> hand;
  for (const std::string& joint : basis->joints) {
    const std::optional<int> variable = geometric::find_variable_of_part(model, joint);
    if (!variable) {
      throw InputError({scene.file.string(), "hand_basis",
                        "joint \"" + joint + "\", which robot " + model.name() + " has not",
                        "a basis for this robot's hand", "The basis is for " + basis->hand});
    }
    hand.push_back(*variable);
  }
  return hand;
}

// A group "arm" without joints that move says nothing, as if it were not there.
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
                             const geometric::Preparation& preparation) {
  geometric::end_if_stopped(preparation.stop);
  const auto world = std::make_shared<const geometric::CollisionWorld>(*scene);
  PlanningProblem problem;
  problem.hand = hand_variables(*scene, basis.get());
  problem.arm = arm_variables(*scene->robots.front().model, problem.hand);
  set_ends(*scene, problem);
  problem.scene = std::move(scene);
  problem.basis = std::move(basis);
  problem.checker =
      geometric::make_collision_checker(world, geometric::CheckerKind::kFast, preparation);
  solve_goals(problem);
  problem.motion = std::make_shared<const geometric::MotionBound>(*world);
  return problem;
}

PlanningProblem updated_problem(const PlanningProblem& before,
                                std::shared_ptr<const geometric::Scene> scene,
                                std::shared_ptr<const sampling::PmdBasis> basis,
                                const geometric::Preparation& preparation) {
  const auto difference = geometric::scene_difference(*before.scene, *scene);
  if (before.basis != basis || !difference || !difference->keeps_order) {
    return make_problem(std::move(scene), std::move(basis), preparation);
  }
  PlanningProblem updated = before;
  set_ends(*scene, updated);
  updated.scene = std::move(scene);
  if (difference->empty()) {
    solve_goals(updated);
    return updated;
  }
  geometric::CollisionWorld world = before.checker->world();
  for (const geometric::ObjectChange& change : difference->changes) {
    world = world.with_change(change);
  }
  const auto shared =
      std::make_shared<const geometric::CollisionWorld>(world.with_constraints_of(*updated.scene));
  updated.motion = std::make_shared<const geometric::MotionBound>(*shared);
  updated.checker =
      geometric::make_collision_checker(shared, geometric::CheckerKind::kFast, preparation);
  solve_goals(updated);
  return updated;
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
