#pragma once

#include "handway/geometric/scene/triangle_mesh.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>

#include <map>
#include <memory>

namespace handway::geometric {

/// FCL's tree of boxes and swept spheres over triangles.
using FclTree = fcl::BVHModel<fcl::OBBRSSd>;

[[nodiscard]] std::shared_ptr<FclTree> make_fcl_tree(const TriangleMesh& mesh);

/// Trees of meshes, each made when it is first asked for: bodies share meshes.
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

}  // namespace handway::geometric
