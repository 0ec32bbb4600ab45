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
  std::vector<std::string> fingertips;   ///< The last link of each finger; bars beside it are none.
  std::string tip;                       ///< Last link of an arm without a hand.
  std::vector<GroupQuestion> questions;  ///< Questions that the user has to decide.

  /// `hand`, and `wrist`, which comes with the hand unless somebody says that the arm has it.
  [[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::string> hand_with_wrist() const;
};

/// Finds arm and hand by the tree, and how large what it carries is. A hand is what branches into
/// fingers of at most 0.4 m that can reach each other, wheels being none, nor eyes; all that leads
/// there is the arm. One or two joints that lead to the fingers
/// of a robot without other arm are a wrist, and three within 0.15 m. Where branches are longer
/// they are arms, each with what it carries: those with a hand, if any has one, so that wheels,
/// heads and legs are neither arm nor hand, and nor is a base that moves. What leads
/// there by up to three joints is a neck, whatever is on its head, beside arms of more joints. A
/// robot that does not branch is an arm.
///
/// If there are several hands, `palm` is the first one's.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT GroupProposal propose_groups(const RobotModel& model);

[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool has_group(const RobotDescription& robot,
                                                      const std::string& name);

/// Adds the groups "arm" and "hand" of the proposal, those that have joints, and the end effector
/// of the hand. Groups and end effectors that are there stay.
HANDWAY_GEOMETRIC_EXPORT void add_groups(const GroupProposal& proposal, RobotDescription& robot);

/// The hand of a robot as a robot of its own, with the names that it has there: what hangs from the
/// last link that all joints of the hand have in common. The hand is the group "hand", or without
/// one what propose_groups() finds.
/// @returns the robot itself if there is nothing to leave out, or no hand.
/// @throws InputError if a joint of the hand follows one of the arm.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::shared_ptr<const RobotModel> hand_alone(
    const std::shared_ptr<const RobotModel>& robot);

}  // namespace handway::geometric
