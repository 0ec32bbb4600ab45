#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/math/units.h"

#include <Eigen/Core>

#include <string>

namespace handway::geometric {

/// A goal given by the pose of a link of the planned robot, instead of by a configuration.
///
/// G is the target of the tool frame T, which is fixed to the link L.
struct PoseGoal {
  std::string link;              ///< Link of robots[0].
  Pose X_WG = Pose::Identity();  ///< Target pose of T in the world.
  /// The object or frame that the target moves with, see follow_objects(); empty: none.
  std::string reference = {};
  Pose X_LT = Pose::Identity();  ///< T in the link's frame.
  std::string tool = {};         ///< The frame of the scene that is T; empty: none.
  /// Allowed distance of T from G along each of G's axes, m; each ≥ 0.
  Eigen::Vector3d position_tolerance = Eigen::Vector3d::Constant(metres(0.1));
  /// Allowed rotation of T against G: each component of the rotation vector from G to T, in G's
  /// axes, rad; each ≥ 0. From π on that axis is free.
  Eigen::Vector3d rotation_tolerance = Eigen::Vector3d::Constant(radians(0.1));

  friend bool operator==(const PoseGoal& a, const PoseGoal& b) {
    return a.link == b.link && a.reference == b.reference && a.tool == b.tool &&
           a.X_WG.matrix() == b.X_WG.matrix() && a.X_LT.matrix() == b.X_LT.matrix() &&
           a.position_tolerance == b.position_tolerance &&
           a.rotation_tolerance == b.rotation_tolerance;
  }
};

/// Error of a tool frame against a goal, along and about the goal's axes.
struct PoseGoalMiss {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< From G to T, m.
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();  ///< Rotation vector from G to T, rad.
};

/// @param X_WL where the goal's link is in the world.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT PoseGoalMiss miss_of(const PoseGoal& goal, const Pose& X_WL);

/// Returns whether `miss` is within the goal's tolerance plus `slack` (m and rad) per component.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool is_within_tolerance(const PoseGoal& goal,
                                                                const PoseGoalMiss& miss,
                                                                double slack);

/// Formats "3.2 mm and 1.5 degrees": the size of `miss`; the distance alone for a goal with free
/// orientation.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string describe_miss(const PoseGoal& goal,
                                                                 const PoseGoalMiss& miss);

}  // namespace handway::geometric
