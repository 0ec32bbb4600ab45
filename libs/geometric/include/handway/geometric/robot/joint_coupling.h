#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_description.h"

#include <string>

namespace handway::geometric {

/// Couples a joint to several others. It becomes a chain of joints about or along the same axis,
/// one for each term, each of which follows one joint: the values of such a chain add up. Those
/// before the last, JOINT/1, JOINT/2, …, carry links without shape of their names; the last keeps
/// name and link.
///
/// The joint keeps its limits: where the sum could leave them, the ranges of the joints that it
/// follows are narrowed towards their neutral values by one share, which keeps the sum within for
/// any of their values, with a warning.
/// @param source, element of the coupling, for messages.
/// @throws InputError if a joint is not there, fixed, of another kind or a follower, the coupling
/// names the joint itself, or the limits are never kept at the neutral values.
HANDWAY_GEOMETRIC_EXPORT void couple_joint(RobotDescription& robot, const JointCoupling& coupling,
                                           const std::string& source, const std::string& element);

}  // namespace handway::geometric
