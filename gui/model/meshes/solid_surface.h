#pragma once

#include "handway/geometric/mesh/triangle_mesh.h"

namespace handway::gui {

/// Returns this surface with coinciding vertices (within a ten-thousandth of a millimetre) merged,
/// also of triangle soups (STL), without degenerate triangles.
[[nodiscard]] geometric::TriangleMesh welded_to_draw(const geometric::TriangleMesh& mesh);

/// Returns whether the mesh is the surface of solids, seen from outside, whose back faces can't be
/// seen: each edge is passed as often one way as the other, and each piece has a volume above 0.
/// @param mesh welded.
[[nodiscard]] bool is_solid(const geometric::TriangleMesh& mesh);

}  // namespace handway::gui
