#pragma once

#include "send_targets.h"

#include <Eigen/Core>

#include <filesystem>
#include <fstream>
#include <vector>

namespace handway::tools {

/// How far a device's joints were from where they should have been; shapes [joints].
class FollowingError {
 public:
  explicit FollowingError(Eigen::Index joints)
      : max_(Eigen::VectorXd::Zero(joints)), squares_(Eigen::VectorXd::Zero(joints)) {}

  void add(const Eigen::VectorXd& error);
  [[nodiscard]] int samples() const { return samples_; }
  [[nodiscard]] const Eigen::VectorXd& max() const { return max_; }  ///< rad
  [[nodiscard]] Eigen::VectorXd rms() const;                         ///< rad

 private:
  Eigen::VectorXd max_;
  Eigen::VectorXd squares_;
  int samples_ = 0;
};

/// Planned and measured joints as CSV, a row for each time a device tells its joints: `time`
/// (s of the motion), `device`, each joint as planned and, as JOINT.measured, as measured (rad);
/// joints of the other device are empty. Rows are written as they come, so that the file is whole
/// whatever happens.
class MotionLog {
 public:
  /// @param file empty: nothing is written.
  /// @throws InputError if it can't be written.
  MotionLog(const std::filesystem::path& file, const std::vector<SendTarget>& targets);

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

}  // namespace handway::tools
