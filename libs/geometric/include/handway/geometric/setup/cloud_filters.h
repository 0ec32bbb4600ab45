#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/mesh/point_cloud.h"
#include "handway/geometric/scene/scene.h"

#include <span>
#include <string>

/// @file
/// Points of a camera are made ready for collision checking: noise, the robot and what it is to
/// grasp are taken out.
namespace handway::geometric {

/// Which points are outliers (R. B. Rusu et al., Towards 3D point cloud based object maps for
/// household environments, Robotics and Autonomous Systems 56, 2008): those whose mean distance
/// from their `neighbours` nearest points exceeds the mean of all points by `deviations` standard
/// deviations.
struct OutlierRule {
  int neighbours = 12;
  double deviations = 3.0;
};

/// Returns the cloud without its outliers; a cloud of at most `neighbours` points as it is.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT PointCloud without_outliers(const PointCloud& cloud,
                                                                   const OutlierRule& rule);

/// Returns the cloud without the points that belong to bodies of a scene: those inside of one, or
/// nearer to its surface than `margin` (m). Bodies are all links of all robots, what they carry,
/// and the named objects.
/// @param X_WC pose of the cloud in the world. @param q configuration of the first robot.
/// @throws InputError if the scene has no object of such a name.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT PointCloud
without_bodies(const PointCloud& cloud, const Pose& X_WC, const Scene& scene,
               const Configuration& q, std::span<const std::string> objects, double margin);

/// Returns the points within a box of the world.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT PointCloud within_box(const PointCloud& cloud,
                                                             const Pose& X_WC, const Aabb& box);

}  // namespace handway::geometric
