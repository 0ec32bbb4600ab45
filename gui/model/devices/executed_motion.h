#pragma once

#include "handway/execution/motion/motion_run.h"
#include "handway/geometric/scene/scene.h"
#include "handway/planning/core/planning_problem.h"

#include <filesystem>
#include <string>
#include <vector>

namespace handway::gui {

/// Reports of the devices during a motion, beside the planned motion.
struct ExecutedMotion {
  struct Device {
    std::string kind;                              ///< "arm" or "hand"
    std::vector<int> variables;                    ///< The robot's that it moves, in its order.
    std::vector<execution::MotionSample> samples;  ///< In order of time.
  };
  std::vector<Device> devices;
  geometric::Configuration start;  ///< Start of the whole robot.
  std::filesystem::path log;       ///< CSV file of this log.

  /// One joint over time.
  struct JointCurve {
    std::vector<double> times;     ///< s
    std::vector<double> planned;   ///< rad
    std::vector<double> measured;  ///< rad
  };
  /// @param variable of the robot. Empty if no device moves it.
  [[nodiscard]] JointCurve curve(int variable) const;
  /// The variable that was farthest off, or -1.
  [[nodiscard]] int worst_variable() const;
  /// Returns the following error of each variable, in proportion to its velocity limit, with the
  /// default for those that no device moves. @returns rad or m, shape [variable_count], see
  /// planning::SafetyMargin.
  [[nodiscard]] Eigen::VectorXd following_error(const geometric::RobotModel& model) const;
  /// The path of a link's origin as it was measured (world, m).
  [[nodiscard]] std::vector<Eigen::Vector3d> link_path(const geometric::RobotInstance& robot,
                                                       int link) const;
};

}  // namespace handway::gui
