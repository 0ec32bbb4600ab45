#pragma once

#include "collision/clearance_field.h"
#include "collision/sphere_cover.h"
#include "handway/geometric/scene/triangle_mesh.h"

#include <boost/uuid/uuid.hpp>

#include <optional>

namespace handway::geometric {

/// Tells meshes of different content apart, and volumes made in different ways.
using MeshKey = boost::uuids::uuid;
[[nodiscard]] MeshKey mesh_key(const TriangleMesh& mesh);

/// What takes long to make of a mesh.
struct CachedVolumes {
  SphereCover cover;
  ClearanceField field;
};

/// From the user's cache ($XDG_CACHE_HOME/handway, else ~/.cache/handway), if it
/// is there and whole; what is broken is as good as not there.
[[nodiscard]] std::optional<CachedVolumes> read_volumes(const MeshKey& key);

/// Adds to the cache, if there is one and it can be written; the oldest entries go
/// when there are too many.
void write_volumes(const MeshKey& key, const CachedVolumes& volumes);

}  // namespace handway::geometric
