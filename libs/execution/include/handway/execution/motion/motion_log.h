#pragma once

#include "handway/execution/export.h"
#include "handway/execution/motion/motion_target.h"

#include <Eigen/Core>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace handway::execution {

/// Writes planned and measured joint positions as CSV, a row for each report of a device: `time`
/// (s of the motion), `device`, the planned position of each joint and, as JOINT.measured, the
/// measured one (rad); joints of other devices are empty. Each row is written at once, so that the
/// file is complete even after a failure.
class HANDWAY_EXECUTION_EXPORT MotionLog {
 public:
  /// @param file path of the CSV file; empty: nothing is written.
  /// @throws InputError if it can't be written.
  MotionLog(const std::filesystem::path& file, const std::vector<MotionTarget>& targets);

  /// Adds a row. @param device index of the target that was measured.
  void add(double time, std::size_t device, const Eigen::VectorXd& planned,
           const Eigen::VectorXd& measured);

  /// Returns false if a row could not be written.
  [[nodiscard]] bool good() const { return !out_.is_open() || out_.good(); }

 private:
  std::vector<std::string> kinds_;
  std::vector<Eigen::Index> joints_;
  std::ofstream out_;
};

/// Planned and measured positions of one device from a MotionLog; rows in the order of the file.
struct RecordedDevice {
  std::string kind;                 ///< "arm", "hand" or "robot"
  std::vector<std::string> joints;  ///< Names of the joints.
  std::vector<double> times;        ///< Motion times, s.
  Eigen::MatrixXd planned;          ///< Planned positions, rad, shape [times, joints].
  Eigen::MatrixXd measured;         ///< Measured positions, rad, shape [times, joints].
};

/// Reads a file written by MotionLog. Devices without rows are left out.
/// @throws InputError with the line if the file is not such a log or has no rows.
[[nodiscard]] HANDWAY_EXECUTION_EXPORT std::vector<RecordedDevice> read_motion_log(
    const std::filesystem::path& file);

/// Following error of one joint: the distance of its measured from its planned positions.
struct JointDifference {
  std::string joint;
  double max = 0.0;   ///< Largest error, rad.
  double time = 0.0;  ///< Motion time of the largest error, s.
  double rms = 0.0;   ///< Root mean square error, rad.
};

/// Returns the following error of each joint of the device; empty without rows.
[[nodiscard]] HANDWAY_EXECUTION_EXPORT std::vector<JointDifference> differences(
    const RecordedDevice& device);

}  // namespace handway::execution
