#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/math/pose.h"

#include <Eigen/Core>

#include <numbers>
#include <string>
#include <variant>

namespace handway::geometric {

/// An axis of the body stays near a direction of the world: a can that is carried upright.
struct OrientationConstraint {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();       ///< In the body's frame, not zero.
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< In the world, not zero.
  double angle = std::numbers::pi / 18.0;  ///< rad, the most between them; in (0, π].

  friend bool operator==(const OrientationConstraint&, const OrientationConstraint&) = default;
};

/// A point of the body stays in a box.
struct PositionConstraint {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< In the body's frame, m.
  Eigen::Vector3d size = Eigen::Vector3d::Ones();   ///< Of the box, m; each above 0.
  Pose X_WR = Pose::Identity();                     ///< The box's middle and axes in the world.

  friend bool operator==(const PositionConstraint& a, const PositionConstraint& b) {
    return a.point == b.point && a.size == b.size && a.X_WR.matrix() == b.X_WR.matrix();
  }
};

/// What has to hold at every configuration of a path, besides that nothing collides.
struct PathConstraint {
  std::string name;  ///< Unique among the scene's constraints.
  std::string body;  ///< An object on a link of the planned robot, or one of its links.
  std::variant<OrientationConstraint, PositionConstraint> what;

  friend bool operator==(const PathConstraint&, const PathConstraint&) = default;
};

}  // namespace handway::geometric
