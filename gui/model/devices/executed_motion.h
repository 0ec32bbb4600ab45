#pragma once

#include "handway/execution/motion/motion_run.h"
#include "handway/geometric/scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace handway::gui {

/// What the devices told while a motion ran, beside what was planned.
struct ExecutedMotion {
  struct Device {
    std::string kind;                              ///< "arm" or "hand"
    std::vector<int> variables;                    ///< The robot's that it moves, in its order.
    std::vector<execution::MotionSample> samples;  ///< In order of time.
  };
  std::vector<Device> devices;
  geometric::Configuration start;  ///< Of the whole robot.
  std::filesystem::path log;       ///< Where the same stands as CSV.

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
  /// The way of a link's origin as it was measured (world, m).
  [[nodiscard]] std::vector<Eigen::Vector3d> way_of(const geometric::RobotInstance& robot,
                                                    int link) const;
};

}  // namespace handway::gui
