#pragma once

#include "handway/device/core/trajectory_client.h"
#include "handway/execution/export.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/timing/trajectory.h"

#include <memory>
#include <string>
#include <vector>

namespace handway::execution {

/// All joints that a path may move: the arm's and the hand's.
inline constexpr const char* kWholeRobot = "robot";

/// A device that runs a part of a motion.
struct MotionTarget {
  std::string kind;            ///< "arm", "hand" or kWholeRobot
  std::vector<int> variables;  ///< The robot's variables that it moves, in its order.
  std::unique_ptr<device::TrajectoryClient> link;
};

/// The variables of the robot's arm, hand or both, in the order in which the robot has them.
/// @param kind "arm", "hand" or kWholeRobot.
[[nodiscard]] HANDWAY_EXECUTION_EXPORT std::vector<int> device_variables(
    const planning::PlanningProblem& problem, const std::string& kind);

/// Ranges and velocities of these variables, as the robot's file has them.
/// @throws InputError if one has no velocity limit: devices move at shares of it.
[[nodiscard]] HANDWAY_EXECUTION_EXPORT device::JointRanges device_joints(
    const geometric::RobotModel& model, const std::vector<int>& variables);

/// Reads "arm://HOST[:PORT]", "hand://HOST[:PORT]", "ros://HOST[:PORT][/CONTROLLER][#arm|#hand]" or
/// "ros2://" the same, or several with commas between; nothing is connected.
/// @throws InputError for anything else, where the robot has no such part, and where two devices
/// would move the same joint.
[[nodiscard]] HANDWAY_EXECUTION_EXPORT std::vector<MotionTarget> parse_targets(
    const std::string& text, const planning::PlanningProblem& problem);

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
