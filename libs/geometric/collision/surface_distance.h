#pragma once

#include "collision/box_tree.h"
#include "handway/geometric/collision/bounded_checker.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/scene/triangle_mesh.h"

namespace handway::geometric {

/// A mesh with the tree of its boxes.
struct Surface {
  const TriangleMesh& mesh;
  const BoxTree& boxes;
};

/// The exact distance (m) of two surfaces, or `enough` if they are at least that
/// far apart; 0 where triangles touch. The less is enough, the sooner it ends.
/// @param X_BA pose of A's frame in B's.
[[nodiscard]] double surface_distance(const Surface& a, const Surface& b, const Pose& X_BA,
                                      double enough);

/// Are the surfaces closer than `tolerance` (m)? Below 1 nm counts as touching.
/// @param witness where to look first: what was closest when it was last asked
/// of nearby poses. Updated.
[[nodiscard]] Closeness surface_closeness(const Surface& a, const Surface& b, const Pose& X_BA,
                                          double tolerance, TrianglePair& witness);

}  // namespace handway::geometric
