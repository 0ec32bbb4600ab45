#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/joint.h"

#include <Eigen/Core>

#include <cstdint>

namespace handway::geometric {

/// What forward kinematics needs of one joint, without names and in one piece
/// of memory: X_BL = X_BP * X_PJ * motion(value), value = multiplier *
/// q[variable] + offset.
struct ForwardKinematicsStep {
  enum class Motion : std::uint8_t {
    kFixed,
    kTurnX,  ///< About +x of the joint frame; an axis -x is folded into the value's sign.
    kTurnY,
    kTurnZ,
    kTurnAxis,  ///< About any other axis.
    kSlide,     ///< Along `axis`.
  };

  Motion motion = Motion::kFixed;
  bool turned = false;  ///< False if X_PJ is a pure translation.
  int parent = 0;       ///< Link index.
  int variable = -1;
  double multiplier = 1.0;
  double offset = 0.0;
  Eigen::Matrix3d R_PJ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p_PJ = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
};

/// @param multiplier, offset the joint's value from its variable (RobotModel::Drive).
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT ForwardKinematicsStep forward_kinematics_step(
    const Joint& joint, int parent, int variable, double multiplier, double offset);

}  // namespace handway::geometric
