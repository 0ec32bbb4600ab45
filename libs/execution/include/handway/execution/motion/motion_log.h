#pragma once

#include "handway/execution/export.h"
#include "handway/execution/motion/motion_target.h"

#include <Eigen/Core>

#include <filesystem>
#include <fstream>
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

}  // namespace handway::execution
