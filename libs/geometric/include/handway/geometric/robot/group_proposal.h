#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_model.h"

#include <memory>
#include <string>
#include <vector>

namespace handway::geometric {

/// Question that the tree leaves open, with advice.
struct GroupQuestion {
  std::string open;
  std::string mend;
};

/// Proposed arm and hand of a robot. Joints in the robot's order, without fixed
/// ones.
struct GroupProposal {
  std::vector<std::string> arm;
  std::vector<std::string> hand;         ///< Joints of the fingers, without `wrist`.
  std::vector<std::string> wrist;        ///< Up to three joints between the root and the palm.
  std::string palm;                      ///< The link that carries the fingers; empty without hand.
  std::vector<std::string> fingertips;   ///< Links of the fingertips: see fingertips().
  std::string tip;                       ///< Last link of an arm without a hand.
  std::vector<GroupQuestion> questions;  ///< Questions that the user has to decide.

  /// Joints of `hand` and `wrist`, which belongs to the hand unless the user gives it to the arm.
  [[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::string> hand_with_wrist() const;
};

/// Finds arm and hand by the tree and the size of its branches. A hand branches into fingers
/// of at most 0.4 m that can reach each other; wheels and eyes are not fingers. All joints
/// that lead to it are the arm. One or two joints that lead to the fingers of a robot
/// without other arm are a wrist, and three within 0.15 m. Longer branches are arms, each
/// with the links that it carries: those with a hand, if any has one, so that wheels, heads
/// and legs are neither arm nor hand, and nor is a moving base. A chain of up to three
/// joints beside longer arms is a neck, whatever it carries. A robot that does not branch is
/// an arm.
///
/// If there are several hands, `palm` is the first one's.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT GroupProposal propose_groups(const RobotModel& model);

/// Returns whether the robot has a group of that name.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool has_group(const RobotDescription& robot,
                                                      const std::string& name);

/// Adds the groups "arm" and "hand" of the proposal, those that have joints, and the end effector
/// of the hand. Existing groups and end effectors stay.
HANDWAY_GEOMETRIC_EXPORT void add_groups(const GroupProposal& proposal, RobotDescription& robot);

/// The hand of a robot as a robot of its own, with its names in the robot: the subtree of the last
/// link that all joints of the hand have in common. The hand is the group "hand", or without one
/// the result of propose_groups().
/// @returns the robot itself if it has nothing to remove, or no hand.
/// @throws InputError if a joint of the hand follows one of the arm.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::shared_ptr<const RobotModel> hand_alone(
    const std::shared_ptr<const RobotModel>& robot);

}  // namespace handway::geometric
