#pragma once

#include "collision/volumes/convex_cover.h"
#include "collision/volumes/sphere_tree.h"
#include "handway/geometric/math/pose.h"

#include <Eigen/Core>

namespace handway::geometric {

/// A lower bound of the distance of two hulls.
struct HullGap {
  float distance = 0.0F;  ///< m; 0: no separating plane was found.
  Eigen::Vector3f p_BA =
      Eigen::Vector3f::Zero();  ///< A's point next to the plane, in B's frame. @pre distance > 0.
};

/// A lower bound of the distance of the contents of two hulls, from a few candidates for a
/// separating plane. The search ends once the bound is `enough` (m).
/// @param X_BA pose of A's frame in B's.
///
/// Source: Gilbert, Johnson and Keerthi, "A fast procedure for computing the distance between
/// complex objects in three-dimensional space", 1988: each step towards the nearest points gives a
/// plane between the hulls.
[[nodiscard]] HullGap hull_gap(const ConvexCover& a, const ConvexCover& b, const FloatPose& X_BA,
                               float enough);

/// A hull in motion about the middle of a stretch of an edge: a share s of the edge further on, its
/// point p has moved by s (v + w × p), and by at most ½ s² `bend` beside that. All in the world.
struct MovingHull {
  const ConvexCover& hull;
  const Pose& X_WHull;  ///< In the middle.
  Eigen::Vector3d v;    ///< m per edge, of the point at the origin.
  Eigen::Vector3d w;    ///< rad per edge.
  double bend;          ///< m per edge².
};

/// hull_gap() of hulls that move along a stretch of an edge: the distance that planes keep between
/// them from the middle of the stretch, where they are in place, to both of its ends.
/// @param half half of the stretch, as a share of the edge.
[[nodiscard]] double hull_gap_along(const MovingHull& a, const MovingHull& b, double half,
                                    double enough);

}  // namespace handway::geometric
