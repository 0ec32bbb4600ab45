#pragma once

#include "handway/execution/motion/motion_target.h"

namespace handway::execution {

/// Returns the tolerances of the joints of one device. @param of_robot their `give` is that of all
/// variables of the robot, [variable_count], or of size 0.
[[nodiscard]] inline device::MotionTolerances tolerances_of(const MotionTarget& target,
                                                            device::MotionTolerances of_robot) {
  if (of_robot.give.size() > 0) {
    of_robot.give = Eigen::VectorXd(of_robot.give(target.variables));
  }
  return of_robot;
}

}  // namespace handway::execution
