#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>

namespace handway::geometric {

/// A rigid transform. `Pose X_AB` is the pose of frame B measured in frame A, so that a point p_BQ
/// of B is p_AQ = X_AB * p_BQ. Metres.
using Pose = Eigen::Isometry3d;

/// Values of a robot's independent joints in the model's variable order,
/// rad (revolute) or m (prismatic). Shape [variable_count].
using Configuration = Eigen::VectorXd;

/// The pose with rotation R = Rz(yaw) Ry(pitch) Rx(roll) (URDF's fixed-axis
/// convention) and translation `xyz`. Radians, metres.
[[nodiscard]] inline Pose pose_from_rpy(const Eigen::Vector3d& xyz, double roll, double pitch,
                                        double yaw) {
  Pose X = Pose::Identity();
  X.translation() = xyz;
  X.linear() = (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  return X;
}

/// The rotation about `rotation_vector` by its length (rad).
[[nodiscard]] inline Eigen::AngleAxisd turn_from_rotation_vector(
    const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  return angle == 0.0 ? Eigen::AngleAxisd::Identity()
                      : Eigen::AngleAxisd(angle, rotation_vector / angle);
}

/// Roll, pitch, yaw (rad) such that pose_from_rpy gives back the rotation of X.
/// At pitch = ±90° roll is taken as 0.
[[nodiscard]] inline Eigen::Vector3d rpy_from_rotation(const Eigen::Matrix3d& R) {
  const double cos_pitch = std::hypot(R(0, 0), R(1, 0));
  const double pitch = std::atan2(-R(2, 0), cos_pitch);
  if (cos_pitch < 1e-12) {
    return {0.0, pitch, std::atan2(-R(0, 1), R(1, 1))};
  }
  return {std::atan2(R(2, 1), R(2, 2)), pitch, std::atan2(R(1, 0), R(0, 0))};
}

}  // namespace handway::geometric
