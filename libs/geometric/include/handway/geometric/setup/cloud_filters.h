#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/mesh/point_cloud.h"
#include "handway/geometric/scene/scene.h"

#include <string>
#include <vector>

/// @file
/// Points of a camera are made ready for collision checking: noise, the robot and what it is to
/// grasp are taken out.
namespace handway::geometric {

/// Outliers are points whose mean distance from their `neighbours` nearest points exceeds the mean
/// of all points by `deviations` standard deviations (R. B. Rusu et al., Towards 3D point cloud
/// based object maps for household environments, Robotics and Autonomous Systems 56, 2008), and is
/// more than twice that mean: the borders of an even surface are none.
struct OutlierRule {
  int neighbours = 12;
  double deviations = 3.0;
};

/// Returns the cloud without its outliers; a cloud of at most `neighbours` points as it is.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT PointCloud without_outliers(const PointCloud& cloud,
                                                                   const OutlierRule& rule);

/// Bodies of a scene whose points are left out: those inside of one, and those nearer to its
/// surface than the margin.
struct BodyFilter {
  bool robots = true;                ///< All links of all robots, and what they carry.
  std::vector<std::string> objects;  ///< Names of other objects.
  double margin = 0.02;              ///< m
};

/// Returns the cloud without the points of these bodies.
/// @param X_WC pose of the cloud in the world. @param q configuration of the first robot.
/// @throws InputError if the scene has no object of such a name.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT PointCloud without_bodies(const PointCloud& cloud,
                                                                 const Pose& X_WC,
                                                                 const Scene& scene,
                                                                 const Configuration& q,
                                                                 const BodyFilter& filter);

/// Returns the points within a box of the world.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT PointCloud within_box(const PointCloud& cloud,
                                                             const Pose& X_WC, const Aabb& box);

}  // namespace handway::geometric
