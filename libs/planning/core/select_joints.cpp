#include "handway/planning/core/select_joints.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/composed_robot.h"
#include "handway/geometric/robot/inverse_kinematics.h"
#include "handway/geometric/setup/moving_group.h"
#include "handway/planning/core/carried_objects.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

using geometric::Configuration;
using geometric::InputError;
using geometric::JointIndices;
using geometric::JointSelection;

// Difference between start and goal up to which a joint does not move, rad or m.
constexpr double kLeastMotion = 1e-6;

// Removes the joints that are in a list in ascending order. Returns whether there were any.
bool remove(JointIndices& joints, const JointIndices& removed) {
  return std::erase_if(joints, [&](int v) { return std::ranges::binary_search(removed, v); }) > 0;
}

// Returns the joints whose goal differs from the start, and those that move the links of goal
// poses. Empty without a goal.
JointIndices joints_with_a_goal(const geometric::Scene& scene) {
  const geometric::RobotInstance& robot = scene.robots.front();
  JointIndices joints;
  for (const geometric::PoseGoal& pose : scene.goal_poses) {
    std::ranges::copy(chain_variables(*robot.model, robot.model->find_link(pose.link).value()),
                      std::back_inserter(joints));
  }
  const Configuration start = scene.start.value_or(robot.configuration);
  const Configuration goal = robot.model->nearest_equivalent(start, scene.goal.value_or(start));
  for (int v = 0; v < std::min(start.size(), goal.size()); ++v) {
    if (std::abs(goal[v] - start[v]) > kLeastMotion) {
      joints.push_back(v);
    }
  }
  return joints;
}

// Returns the joints of the limbs that the goal does not move, ascending. Empty if the scene has a
// group, or if the goal moves no limb.
JointIndices fixed_limb_joints(const geometric::Scene& scene) {
  if (!scene.group.empty()) {
    return {};
  }
  const geometric::RobotModel& model = *scene.robots.front().model;
  const JointIndices wanted = joints_with_a_goal(scene);
  const auto is_wanted = [&](int v) { return std::ranges::count(wanted, v) > 0; };
  JointIndices fixed;
  bool any_moves = false;
  for (const geometric::Limb& limb : limbs(model, JointSelection::of_groups(model))) {
    if (std::ranges::any_of(limb.arm, is_wanted) || std::ranges::any_of(limb.hand, is_wanted)) {
      any_moves = true;
    } else {
      std::ranges::copy(limb.arm, std::back_inserter(fixed));
      std::ranges::copy(limb.hand, std::back_inserter(fixed));
    }
  }
  std::ranges::sort(fixed);
  return any_moves ? fixed : JointIndices();
}

// Returns the joints that hold the carried objects, ascending. Empty if the scene has a group,
// which selects the moving joints itself.
JointIndices holding_joints(const geometric::Scene& scene) {
  JointIndices holding;
  if (!scene.group.empty()) {
    return holding;
  }
  for (const CarriedObject& object : carried_objects(scene)) {
    std::ranges::copy(object.holding, std::back_inserter(holding));
  }
  std::ranges::sort(holding);
  holding.erase(std::unique(holding.begin(), holding.end()), holding.end());
  return holding;
}

// Returns the joint of the robot for a joint of a basis. If several parts have such a joint,
// returns that of the part that moves.
std::optional<int> hand_joint(const geometric::RobotModel& model, JointIndices moving,
                              const std::string& joint) {
  std::erase_if(moving, [&](int v) {
    const std::string& name = model.variable(v).name;
    return name != joint && !name.ends_with('/' + joint);
  });
  return moving.size() == 1 ? std::optional(moving.front())
                            : geometric::find_variable_of_part(model, joint);
}

enum class MissingJoints { kRefused, kLeftOut };

// Returns the joints of the hand, moving or not. @param moving those that the goal may move.
// @param missing what to do with joints of the basis that the robot lacks.
JointIndices hand_joints(const geometric::Scene& scene, const sampling::PmdBasis* basis,
                         const JointIndices& moving, MissingJoints missing) {
  const geometric::RobotModel& model = *scene.robots.front().model;
  if (!basis) {
    return model.find_group("hand").value_or(JointIndices{});
  }
  JointIndices hand;
  for (const std::string& joint : basis->joints) {
    const std::optional<int> variable = hand_joint(model, moving, joint);
    if (variable) {
      hand.push_back(*variable);
    } else if (missing == MissingJoints::kRefused) {
      throw InputError({scene.file.string(), "hand_basis",
                        "joint \"" + joint + "\", which robot " + model.name() + " has not",
                        "a basis for this robot's hand", "The basis is for " + basis->hand});
    }
  }
  return hand;
}

// Selects by basis, groups and the scene's group. @param at_rest joints that the goal leaves at the
// start, ascending: if there is a choice, the basis is not for a hand with them.
JointSelection movable_joints(const geometric::Scene& scene, const sampling::PmdBasis* basis,
                              const JointIndices& at_rest, MissingJoints missing) {
  const JointIndices moving = geometric::moving_variables(scene);
  JointIndices candidates = moving;
  remove(candidates, at_rest);
  JointIndices whole_hand = hand_joints(scene, basis, candidates, missing);
  JointIndices hand = whole_hand;
  std::erase_if(hand, [&](int v) { return !std::ranges::binary_search(moving, v); });
  JointSelection joints = JointSelection::with_hand(*scene.robots.front().model, std::move(hand));
  joints.moves_whole_hand = joints.hand.size() == whole_hand.size();
  joints.whole_hand = std::move(whole_hand);
  joints.set_moving(moving);
  if (!scene.group.empty()) {
    joints.arm = moving;
    std::erase_if(joints.arm, [&](int v) { return std::ranges::count(joints.hand, v) > 0; });
  }
  return joints;
}

}  // namespace

JointSelection select_joints(const geometric::Scene& scene, const sampling::PmdBasis* basis) {
  JointIndices at_rest = fixed_limb_joints(scene);
  JointSelection joints = movable_joints(scene, basis, at_rest, MissingJoints::kRefused);
  joints.fixed_limb_joints = std::move(at_rest);
  joints.holding = holding_joints(scene);
  remove(joints.hand, joints.fixed_limb_joints);
  remove(joints.arm, joints.fixed_limb_joints);
  if (remove(joints.hand, joints.holding)) {
    joints.moves_whole_hand = false;
  }
  remove(joints.arm, joints.holding);
  return joints;
}

JointSelection select_movable_joints(const geometric::Scene& scene,
                                     const sampling::PmdBasis* basis) {
  return movable_joints(scene, basis, fixed_limb_joints(scene), MissingJoints::kLeftOut);
}

JointSelection select_joints(const geometric::RobotModel& model, const sampling::PmdBasis* basis) {
  if (!basis) {
    return JointSelection::of_groups(model);
  }
  JointIndices hand;
  for (const std::string& joint : basis->joints) {
    if (const std::optional<int> variable = geometric::find_variable_of_part(model, joint)) {
      hand.push_back(*variable);
    }
  }
  return JointSelection::with_hand(model, std::move(hand));
}

}  // namespace handway::planning
