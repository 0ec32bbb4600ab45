#pragma once

#include "handway/geometric/scene/triangle_mesh.h"

#include <vector>

namespace handway::geometric {

/// The parts of a mesh that hang together, vertices at the same place being one and equal triangles
/// too; those with the
/// longest box diagonal first.
[[nodiscard]] std::vector<TriangleMesh> pieces_of(const TriangleMesh& mesh);

}  // namespace handway::geometric
