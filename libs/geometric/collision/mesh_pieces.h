#pragma once

#include "handway/geometric/scene/triangle_mesh.h"

#include <vector>

namespace handway::geometric {

/// The parts of a mesh that hang together, vertices at the same place being one; those with the
/// longest box diagonal first.
[[nodiscard]] std::vector<TriangleMesh> pieces_of(const TriangleMesh& mesh);

/// Whether every edge belongs to an even number of triangles: then the surface has two sides,
/// and whoever gets from one to the other goes through it.
/// @param piece as pieces_of() gives it: no two vertices are at the same place.
[[nodiscard]] bool is_closed(const TriangleMesh& piece);

}  // namespace handway::geometric
