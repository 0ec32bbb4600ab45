#pragma once

#include "handway/geometric/scene/triangle_mesh.h"

namespace handway::gui {

/// The same surface with one vertex a place (within a ten-thousandth of a millimetre), also of
/// triangle soups (STL), without triangles that have a place twice.
[[nodiscard]] geometric::TriangleMesh welded_to_draw(const geometric::TriangleMesh& mesh);

/// Is it the surface of solids, seen from outside? Then triangles that look away can't be seen.
/// Each edge is passed as often one way as the other, and each piece has a volume above 0.
/// @param mesh welded.
[[nodiscard]] bool is_solid(const geometric::TriangleMesh& mesh);

}  // namespace handway::gui
