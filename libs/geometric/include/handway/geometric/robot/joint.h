#pragma once

#include "handway/geometric/math/pose.h"

#include <Eigen/Core>

#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace handway::geometric {

enum class JointType { kFixed, kRevolute, kPrismatic };

/// Limits of a joint: rad, rad/s, rad/s² (revolute) or m, m/s, m/s² (prismatic). Those of a
/// continuous joint, a revolute one that turns without end, are infinite.
struct JointLimits {
  double lower = 0.0;
  double upper = 0.0;
  double velocity = std::numeric_limits<double>::infinity();
  double acceleration = std::numeric_limits<double>::infinity();

  [[nodiscard]] double range() const { return upper - lower; }
};

/// Linear coupling: q = multiplier * q_of(joint) + offset (URDF's `mimic`).
struct Mimic {
  std::string joint;
  double multiplier = 1.0;
  double offset = 0.0;
};

/// Connects a child link to its parent. With P the parent's frame and J the
/// joint's own, X_PJ is fixed and the child moves by q about (revolute) or
/// along (prismatic) `axis`, a unit vector in J.
struct Joint {
  std::string name;
  JointType type = JointType::kFixed;
  std::string parent;  ///< Link name.
  std::string child;   ///< Link name.
  Pose X_PJ = Pose::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  JointLimits limits;
  std::optional<Mimic> mimic;

  /// A revolute joint without ends, which comes round again after a whole turn.
  [[nodiscard]] bool is_continuous() const {
    return type == JointType::kRevolute && std::isinf(limits.lower) && std::isinf(limits.upper);
  }
};

}  // namespace handway::geometric
