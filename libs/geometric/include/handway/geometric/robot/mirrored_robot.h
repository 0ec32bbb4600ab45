#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_description.h"

namespace handway::geometric {

/// The mirror image of a robot, in the plane y = 0 of its root link: a left hand from a right one,
/// or the other way round. Every posture of it is the mirror image of the same posture of `robot`,
/// joint by joint. Names stay, so that postures, mappings and hand bases of one serve the other;
/// but "right" in the robot's own name becomes "left" and "left" "right", or it ends in
/// "_mirrored".
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT RobotDescription mirrored(RobotDescription robot);

}  // namespace handway::geometric
