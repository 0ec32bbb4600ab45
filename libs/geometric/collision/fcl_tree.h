#pragma once

#include "handway/geometric/scene/triangle_mesh.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>

#include <memory>

namespace handway::geometric {

/// FCL's tree of boxes and swept spheres over triangles.
using FclTree = fcl::BVHModel<fcl::OBBRSSd>;

[[nodiscard]] std::shared_ptr<FclTree> make_fcl_tree(const TriangleMesh& mesh);

}  // namespace handway::geometric
