#pragma once

#include "handway/execution/export.h"
#include "handway/execution/motion/motion_target.h"

#include <Eigen/Core>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace handway::execution {

/// Planned and measured joints as CSV, a row for each time a device reports its joints: `time`
/// (s of the motion), `device`, each joint as planned and, as JOINT.measured, as measured (rad);
/// joints of the other device are empty. Rows are written as they come, so that the file is whole
/// whatever happens.
class HANDWAY_EXECUTION_EXPORT MotionLog {
 public:
  /// @param file empty: nothing is written.
  /// @throws InputError if it can't be written.
  MotionLog(const std::filesystem::path& file, const std::vector<MotionTarget>& targets);

  /// @param device index of the target that measured.
  void add(double time, std::size_t device, const Eigen::VectorXd& planned,
           const Eigen::VectorXd& measured);

  /// False if a row could not be written.
  [[nodiscard]] bool good() const { return !out_.is_open() || out_.good(); }

 private:
  std::vector<std::string> kinds_;
  std::vector<Eigen::Index> joints_;
  std::ofstream out_;
};

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
