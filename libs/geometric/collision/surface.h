#pragma once

#include "collision/clearance_field.h"
#include "collision/convex_cover.h"
#include "collision/on_demand.h"
#include "collision/sided_boxes.h"
#include "collision/sphere_cover.h"
#include "collision/surface_points.h"
#include "collision/triangle_tree.h"
#include "handway/geometric/collision/preparation.h"
#include "handway/geometric/io/disk_cache.h"
#include "handway/geometric/scene/triangle_mesh.h"

#include <memory>
#include <vector>

namespace handway::geometric {

/// A mesh with what makes questions about it fast. Immutable, shared.
struct Surface {
  CacheKey key;  ///< Of the mesh's content.
  std::shared_ptr<const TriangleMesh> mesh;
  SphereCover cover;
  ClearanceField field;
  OnDemand<TriangleTree> triangles;
  OnDemand<ConvexCover> hull;
  OnDemand<SurfaceSides> sides;
  OnDemand<SurfacePoints> points;
};

/// The surfaces of `meshes`, in order. Meshes of the same content share one; what
/// another part of the program still holds is not made again. Of primitives next to nothing is made
/// before it is asked for; of other meshes, what an earlier run made is read from the user's cache,
/// and all processors make the rest.
/// @throws PreparationStopped where `preparation` asks for it.
[[nodiscard]] std::vector<std::shared_ptr<const Surface>> make_surfaces(
    const std::vector<std::shared_ptr<const TriangleMesh>>& meshes,
    const Preparation& preparation = {});

}  // namespace handway::geometric
