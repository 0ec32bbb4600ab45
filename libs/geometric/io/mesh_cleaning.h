#pragma once

#include "handway/geometric/scene/triangle_mesh.h"

namespace handway::geometric {

/// `mesh` with equal vertices joined, triangles without area dropped, and
/// vertices that no triangle uses left out. Order is kept.
[[nodiscard]] TriangleMesh cleaned(const TriangleMesh& mesh);

}  // namespace handway::geometric
