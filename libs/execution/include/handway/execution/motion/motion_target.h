#pragma once

#include "handway/device/core/trajectory_client.h"
#include "handway/execution/export.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/timing/trajectory.h"

#include <memory>
#include <string>
#include <vector>

namespace handway::execution {

/// Kind of a target that moves all joints that a path may move: the arm's and the hand's.
inline constexpr const char* kWholeRobot = "robot";

/// A device that runs a part of a motion.
struct MotionTarget {
  std::string kind;  ///< "arm", "hand" or kWholeRobot
  /// Joints of the robot that the device moves, in the device's order.
  geometric::JointIndices variables;
  std::unique_ptr<device::TrajectoryClient> link;
};

/// Returns the ranges and nominal velocities of these variables from the robot's file.
/// @throws InputError if one has no velocity limit: devices move at fractions of it.
[[nodiscard]] HANDWAY_EXECUTION_EXPORT device::JointRanges device_joints(
    const geometric::RobotModel& model, const geometric::JointIndices& variables);

/// Reads "arm://HOST[:PORT]", "hand://HOST[:PORT]", "ros://HOST[:PORT][/CONTROLLER][#arm|#hand]" or
/// "ros2://" with the same parts; several are separated by commas. Connects nothing.
/// @throws InputError for anything else, for a part that the robot lacks, and if two devices would
/// move the same joint.
[[nodiscard]] HANDWAY_EXECUTION_EXPORT std::vector<MotionTarget> parse_targets(
    const std::string& text, const planning::PlanningProblem& problem);

/// Returns `q` with the measured positions of the connected devices. @param q [variable_count].
[[nodiscard]] HANDWAY_EXECUTION_EXPORT planning::Configuration with_measured(
    planning::Configuration q, const std::vector<MotionTarget>& targets);

/// Checks that the path keeps joints without a device at rest.
/// @throws InputError with the first joint that the path moves and that has no device.
HANDWAY_EXECUTION_EXPORT void check_that_the_rest_stands(const geometric::RobotModel& model,
                                                         const planning::Path& path,
                                                         const std::vector<MotionTarget>& targets);

/// Returns the part of a trajectory that a device runs, with times from 0.
/// @param variables robot variables that the device moves.
[[nodiscard]] HANDWAY_EXECUTION_EXPORT device::JointTrajectory part_of(
    const planning::Trajectory& trajectory, const geometric::JointIndices& variables);

}  // namespace handway::execution
