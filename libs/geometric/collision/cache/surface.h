#pragma once

#include "collision/volumes/convex_cover.h"
#include "collision/volumes/distance_field.h"
#include "collision/volumes/inner_balls.h"
#include "collision/volumes/on_demand.h"
#include "collision/volumes/sphere_tree.h"
#include "collision/volumes/triangle_tree.h"
#include "handway/geometric/collision/volumes/preparation.h"
#include "handway/geometric/io/disk_cache.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <memory>
#include <string>
#include <vector>

namespace handway::geometric {

/// Volumes of a mesh that take long to compute.
struct MeshVolumes {
  SphereTree cover;
  ConvexCover hull;
  DistanceField field;
  std::vector<InnerBall> balls;
};

/// Returns a text that changes with the byte layout of archived volumes: a part of their key.
[[nodiscard]] std::string archive_layout();

/// Volumes as bytes, for this kind of processor.
[[nodiscard]] std::string archive_volumes(const MeshVolumes& volumes);

/// @pre `bytes` are what archive_volumes() gave.
[[nodiscard]] MeshVolumes unarchive_volumes(const std::string& bytes);

/// A mesh with the volumes that make queries fast. Immutable, shared.
struct Surface {
  CacheKey key;  ///< Hash of the mesh's content.
  std::shared_ptr<const TriangleMesh> mesh;
  SphereTree cover;
  DistanceField field;
  OnDemand<TriangleTree> triangles;
  OnDemand<ConvexCover> hull;
  OnDemand<std::vector<InnerBall>> balls;  ///< inner_balls().
};

/// Makes the surfaces of `meshes`, in order. Meshes of the same content share one;
/// surfaces in use elsewhere in the program are reused. Primitives are made almost
/// entirely on demand; other meshes are read from the user's cache, or made by all
/// processors.
/// @throws PreparationStopped if `preparation` is stopped.
[[nodiscard]] std::vector<std::shared_ptr<const Surface>> make_surfaces(
    const std::vector<std::shared_ptr<const TriangleMesh>>& meshes,
    const Preparation& preparation = {});

}  // namespace handway::geometric
