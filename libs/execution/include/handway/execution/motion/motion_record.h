#pragma once

#include "handway/execution/export.h"

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

namespace handway::execution {

/// What one device was to do, and did, as a MotionLog has it; rows in order of time.
struct RecordedDevice {
  std::string kind;                 ///< "arm", "hand" or "robot"
  std::vector<std::string> joints;  ///< By name.
  std::vector<double> times;        ///< s of the motion.
  Eigen::MatrixXd planned;          ///< rad, shape [times, joints].
  Eigen::MatrixXd measured;         ///< rad, shape [times, joints].
};

/// Reads what a MotionLog wrote. Devices that reported nothing are left out.
/// @throws InputError with line for a file that is none, or with nothing in it.
[[nodiscard]] HANDWAY_EXECUTION_EXPORT std::vector<RecordedDevice> read_motion_log(
    const std::filesystem::path& file);

/// How far a joint was from where it should have been.
struct JointDifference {
  std::string joint;
  double max = 0.0;   ///< rad
  double time = 0.0;  ///< When it was farthest, s.
  double rms = 0.0;   ///< rad
};

/// Of every joint of the device. @pre it has times.
[[nodiscard]] HANDWAY_EXECUTION_EXPORT std::vector<JointDifference> differences(
    const RecordedDevice& device);

}  // namespace handway::execution
