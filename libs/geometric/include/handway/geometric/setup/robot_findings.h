#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/group_proposal.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/geometric/setup/collision_sampling.h"

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

}  // namespace handway::geometric
