#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/group_proposal.h"
#include "handway/geometric/robot/robot_description.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/geometric/setup/collision_sampling.h"

#include <map>
#include <string>
#include <vector>

namespace handway::geometric {

/// Something of a robot file that can be read and yet looks wrong, or that a person has to decide.
struct RobotFinding {
  std::string found;
  std::string mend;
  std::vector<std::string> links = {};  ///< That it is about; may be empty.
  /// Seen with every joint in the middle of its range, not at the neutral posture.
  bool at_middle = false;
};

/// Looks at shapes (faces that point inwards, sizes that speak of wrong units, open surfaces), at
/// joints without velocity limit, at pairs of links that touch at the neutral or the middle posture
/// or in most samples, and at what is open about the groups. Empty if nothing is suspicious.
/// @param sampled of this model.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<RobotFinding> examine_robot(
    const RobotModel& model, const SelfCollisionSamples& sampled, const GroupProposal& groups);

/// Owner of the joints between root and palm, which the tree alone does not determine.
enum class WristOwner { kUndecided, kArm, kHand };

/// propose_groups(), with the wrist counted to the arm or the hand if somebody has decided that.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT GroupProposal decided_groups(const RobotModel& model,
                                                                    WristOwner wrist);

/// Decisions of the user about a robot.
struct SetupDecisions {
  WristOwner wrist = WristOwner::kUndecided;
  std::map<AllowedCollisions::Pair, bool> may_touch = {};
};

/// The robot with the allowed-collision matrix that was sampled and the groups and end effectors
/// that it has not. Pairs that somebody has allowed (User) stay, unless `decisions` say otherwise.
/// @param sampled of this model. @param groups decided_groups() of it.
/// @param decisions if the wrist is decided, the groups "arm" and "hand" that there are are
/// replaced.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT RobotDescription
with_setup(const RobotModel& model, const SelfCollisionSamples& sampled,
           const GroupProposal& groups, const SetupDecisions& decisions);

}  // namespace handway::geometric
