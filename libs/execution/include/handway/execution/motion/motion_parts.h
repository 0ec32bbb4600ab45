#pragma once

#include "handway/execution/export.h"
#include "handway/execution/motion/motion_target.h"
#include "handway/planning/core/path.h"
#include "handway/planning/timing/trajectory.h"

#include <vector>

namespace handway::execution {

/// `q` with what the connected devices measure in it. @param q shape [variable_count].
[[nodiscard]] HANDWAY_EXECUTION_EXPORT planning::Configuration with_measured(
    planning::Configuration q, const std::vector<MotionTarget>& targets);

/// Joints without a device have to stand, as nobody would move them.
/// @throws InputError naming the first joint that the path moves and no device does.
HANDWAY_EXECUTION_EXPORT void check_that_the_rest_stands(const geometric::RobotModel& model,
                                                         const planning::Path& path,
                                                         const std::vector<MotionTarget>& targets);

/// The part of a trajectory that a device runs, from time 0.
/// @param variables that it moves.
[[nodiscard]] HANDWAY_EXECUTION_EXPORT device::JointTrajectory part_of(
    const planning::Trajectory& trajectory, const std::vector<int>& variables);

}  // namespace handway::execution
