#pragma once

#include "handway/device/core/motion_link.h"
#include "handway/execution/export.h"
#include "handway/planning/core/planning_problem.h"

#include <memory>
#include <string>
#include <vector>

namespace handway::execution {

/// A device that runs a part of a motion.
struct MotionTarget {
  std::string kind;            ///< "arm" or "hand"
  std::vector<int> variables;  ///< The robot's variables that it moves, in its order.
  std::unique_ptr<device::MotionLink> link;
};

/// The variables of the robot's arm, or hand, in the order in which the robot has them.
[[nodiscard]] HANDWAY_EXECUTION_EXPORT std::vector<int> device_variables(
    const planning::PlanningProblem& problem, const std::string& kind);

/// Ranges and velocities of these variables, as the robot's file has them.
/// @throws InputError if one has no velocity limit: devices move at shares of it.
[[nodiscard]] HANDWAY_EXECUTION_EXPORT device::JointRanges device_joints(
    const geometric::RobotModel& model, const std::vector<int>& variables);

/// Reads "arm://HOST[:PORT]", "hand://HOST[:PORT]" or both with a comma between; nothing is
/// connected.
/// @throws InputError for anything else, and where the robot has no such part.
[[nodiscard]] HANDWAY_EXECUTION_EXPORT std::vector<MotionTarget> parse_targets(
    const std::string& text, const planning::PlanningProblem& problem);

}  // namespace handway::execution
