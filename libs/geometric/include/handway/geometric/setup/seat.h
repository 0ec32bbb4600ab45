#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/robot/robot_model.h"

#include <optional>
#include <string>

namespace handway::geometric {

/// Place of one robot on another.
struct Seat {
  std::string link;  ///< Link of the carrier.
  Pose X_LB;         ///< Root link of the mounted robot in that link.
};

/// Returns the seat at the end of an arm: on its tip (propose_groups()), with the fingers, or else
/// the root's z axis, along that axis of the tip that points out of the arm, and so far out that no
/// collision geometry of the mounted robot, in its neutral posture, is behind the tip's origin. A
/// hand with its root at the mounting face sits directly on the tip; one whose root is within the
/// palm is moved out.
/// @returns std::nullopt if the carrier is not one arm with a free end.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<Seat> find_seat(const RobotModel& carrier,
                                                                     const RobotModel& mounted);

}  // namespace handway::geometric
