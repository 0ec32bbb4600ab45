#pragma once

#include "handway/geometric/collision/collision_world.h"

#include <Eigen/Geometry>

#include <unsupported/Eigen/BVH>
#include <vector>

namespace handway::geometric {

/// The bodies of a world that stand still in a tree of their boxes, so that those
/// near a place are found without looking at all.
class StillBodies {
 public:
  /// @param p_WO where places are reckoned from.
  StillBodies(const CollisionWorld& world, const Eigen::Vector3d& p_WO);

  /// Adds the pairs of the moving body `body` with what stands still nearer than
  /// `reach` (m) to `centre`, by its box along the axes of the world, and maybe some more.
  void append_near(int body, const Eigen::Vector3f& centre, float reach,
                   std::vector<int>& pairs) const;

 private:
  Eigen::KdBVH<float, 3, int> tree_;       ///< Of numbers of still bodies.
  std::vector<std::vector<int>> pair_of_;  ///< Per body and still body: the pair; -1: none.
};

}  // namespace handway::geometric
