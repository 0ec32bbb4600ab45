#include "handway/geometric/robot/joint_selection.h"

#include "handway/geometric/robot/inverse_kinematics.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <utility>

namespace handway::geometric {
namespace {

JointIndices all_joints(std::size_t count) {
  JointIndices all(count);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

bool contains(const JointIndices& joints, int joint) {
  return std::ranges::find(joints, joint) != joints.end();
}

}  // namespace

JointSelection JointSelection::of_groups(const RobotModel& model) {
  return with_hand(model, model.find_group("hand").value_or(JointIndices{}));
}

// A group "arm" without joints, or with the hand's only, counts as missing.
JointSelection JointSelection::with_hand(const RobotModel& model, JointIndices hand) {
  JointSelection joints;
  joints.hand = std::move(hand);
  joints.whole_hand = joints.hand;
  joints.moving = all_joints(static_cast<std::size_t>(model.variable_count()));
  const auto is_of_hand = [&](int joint) { return contains(joints.hand, joint); };
  joints.arm = model.find_group("arm").value_or(JointIndices{});
  std::erase_if(joints.arm, is_of_hand);
  if (joints.arm.empty()) {
    joints.arm = joints.moving;
    std::erase_if(joints.arm, is_of_hand);
  }
  return joints;
}

void JointSelection::set_moving(JointIndices joints) {
  fixed = all_joints(moving.size() + fixed.size());
  moving = std::move(joints);
  std::erase_if(fixed, [&](int joint) { return std::ranges::binary_search(moving, joint); });
}

JointIndices JointSelection::planned(const Configuration& start, const Configuration& goal) const {
  JointIndices planned = moving;
  std::erase_if(planned, [&](int joint) {
    return !contains(arm, joint) && !contains(hand, joint) && start[joint] == goal[joint];
  });
  return planned;
}

JointIndices JointSelection::of_part(std::string_view part) const {
  JointIndices joints;
  if (part != "hand") {
    joints = arm;
  }
  if (part != "arm") {
    joints.insert(joints.end(), hand.begin(), hand.end());
  }
  std::ranges::sort(joints);
  return joints;
}

JointIndices JointSelection::outside_arm_and_hand() const {
  JointIndices others = all_joints(moving.size() + fixed.size());
  std::erase_if(others, [&](int joint) { return contains(arm, joint) || contains(hand, joint); });
  return others;
}

std::vector<Limb> limbs(const RobotModel& model, const JointSelection& joints) {
  const JointIndices& arm = joints.arm;
  const auto moves = [&](int joint, int other) {
    const JointIndices chain = chain_variables(model, model.variable_link(other));
    return std::ranges::binary_search(chain, joint);
  };
  JointIndices ends = arm;
  std::erase_if(ends, [&](int v) {
    return std::ranges::any_of(arm, [&](int other) { return other != v && moves(v, other); });
  });
  std::ranges::sort(ends);
  std::vector<Limb> found;
  for (const int end : ends) {
    Limb limb;
    std::ranges::copy_if(arm, std::back_inserter(limb.arm), [&](int v) {
      return moves(v, end) &&
             std::ranges::count_if(ends, [&](int other) { return moves(v, other); }) == 1;
    });
    std::ranges::sort(limb.arm);
    std::ranges::copy_if(joints.hand, std::back_inserter(limb.hand), [&](int h) {
      return std::ranges::any_of(limb.arm, [&](int v) { return moves(v, h); });
    });
    found.push_back(std::move(limb));
  }
  return found;
}

}  // namespace handway::geometric
