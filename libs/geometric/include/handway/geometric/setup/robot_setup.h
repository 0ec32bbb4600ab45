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

/// Suspicious part of a readable robot file, or a decision that the user has to make.
struct RobotFinding {
  std::string found;
  std::string mend;
  std::vector<std::string> links = {};  ///< Links concerned; may be empty.
  /// Found with every joint in the middle of its range, not at the neutral posture.
  bool at_middle = false;
};

/// Examines shapes (inward faces, sizes that suggest wrong units, open surfaces), joints without
/// velocity limit, pairs of links that touch at the neutral or the middle posture or in most
/// samples, and open questions about the groups. Empty if nothing is suspicious.
/// @param sampled of this model.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<RobotFinding> examine_robot(
    const RobotModel& model, const SelfCollisionSamples& sampled, const GroupProposal& groups);

/// Owner of the joints between root and palm, which the tree alone does not determine.
enum class WristOwner { kUndecided, kArm, kHand };

/// Returns propose_groups(), with the wrist assigned to the arm or the hand if that is decided.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT GroupProposal decided_groups(const RobotModel& model,
                                                                    WristOwner wrist);

/// Decisions of the user about a robot.
struct SetupDecisions {
  WristOwner wrist = WristOwner::kUndecided;
  std::map<AllowedCollisions::Pair, bool> allowed_collisions = {};
};

/// Returns the robot with the sampled allowed-collision matrix and the groups and end effectors
/// that it lacks. Pairs allowed by the user (User) stay, unless `decisions` overrides them.
/// @param sampled of this model. @param groups decided_groups() of it.
/// @param decisions if the wrist is decided, existing groups "arm" and "hand" are
/// replaced.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT RobotDescription
with_setup(const RobotModel& model, const SelfCollisionSamples& sampled,
           const GroupProposal& groups, const SetupDecisions& decisions);

}  // namespace handway::geometric
