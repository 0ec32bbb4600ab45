#pragma once

#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>

#include <map>
#include <memory>
#include <vector>

namespace handway::geometric {

/// FCL's tree of boxes and swept spheres over triangles.
using FclTree = fcl::BVHModel<fcl::OBBRSSd>;

[[nodiscard]] std::shared_ptr<FclTree> make_fcl_tree(const TriangleMesh& mesh);

/// Trees of meshes, each made on first access: bodies share meshes.
class FclTrees {
 public:
  /// @param mesh outlives the trees.
  const std::shared_ptr<FclTree>& of(const TriangleMesh& mesh) {
    std::shared_ptr<FclTree>& tree = made_[&mesh];
    if (!tree) {
      tree = make_fcl_tree(mesh);
    }
    return tree;
  }

 private:
  std::map<const TriangleMesh*, std::shared_ptr<FclTree>> made_;
};

/// FCL's trees of all bodies of a world, shared by the checkers that use FCL.
class FclBodies {
 public:
  explicit FclBodies(const CollisionWorld& world);
  ~FclBodies();
  FclBodies(const FclBodies&) = delete;
  FclBodies& operator=(const FclBodies&) = delete;

  [[nodiscard]] bool collide(int a, const Pose& X_WA, int b, const Pose& X_WB) const;

  /// Distance (m) if below `enough`, else any value from `enough` up; 0 if they touch.
  [[nodiscard]] double distance(int a, const Pose& X_WA, int b, const Pose& X_WB,
                                double enough) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace handway::geometric
