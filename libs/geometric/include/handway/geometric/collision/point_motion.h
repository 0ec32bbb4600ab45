#pragma once

#include <Eigen/Core>

namespace handway::geometric {

/// Motion of a body's points about the middle of a stretch of an edge, in the world: a share s of
/// the edge further on, point p has moved by s (v + w × p), and by at most ½ s² `bend` beside that.
struct PointMotion {
  Eigen::Vector3d v = Eigen::Vector3d::Zero();  ///< m per edge, of the point at the origin.
  Eigen::Vector3d w = Eigen::Vector3d::Zero();  ///< rad per edge.
  double bend = 0.0;                            ///< m per edge².
};

/// Motions of a pair's bodies, seen from the closest common ancestor of their links.
struct PairMotion {
  PointMotion a;
  PointMotion b;
};

}  // namespace handway::geometric
