#pragma once

#include "handway/execution/export.h"

#include <Eigen/Core>

namespace handway::execution {

/// How far a device's joints were from where they should have been; shapes [joints].
class HANDWAY_EXECUTION_EXPORT FollowingError {
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

}  // namespace handway::execution
