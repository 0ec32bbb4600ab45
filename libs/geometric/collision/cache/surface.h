#pragma once

#include "collision/volumes/convex_cover.h"
#include "collision/volumes/distance_field.h"
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
};

/// Returns a text that changes with the byte layout of archived volumes: a part of their key.
[[nodiscard]] std::string archive_layout();

/// Volumes as bytes, for this kind of processor.
[[nodiscard]] std::string archive_volumes(const MeshVolumes& volumes);

/// @pre `bytes` are what archive_volumes() gave.
[[nodiscard]] MeshVolumes unarchive_volumes(const std::string& bytes);

/// A mesh with what makes questions about it fast. Immutable, shared.
struct Surface {
  CacheKey key;  ///< Hash of the mesh's content.
  std::shared_ptr<const TriangleMesh> mesh;
  SphereTree cover;
  DistanceField field;
  OnDemand<TriangleTree> triangles;
  OnDemand<ConvexCover> hull;
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
