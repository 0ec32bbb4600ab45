#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/scene/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace handway::geometric {

/// The same triangles with one vertex a place, also of triangle soups (STL). A triangle may have
/// a vertex twice then.
/// @param grid m: places are one if they round to the same multiple of it; 0: if they are equal.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT TriangleMesh welded(const TriangleMesh& mesh,
                                                           double grid = 0.0);

/// For every vertex the number of the piece that it belongs to, from 0: vertices of one piece hang
/// together by triangles. A vertex without triangles is a piece of its own.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::uint32_t> piece_numbers(
    const TriangleMesh& mesh);

}  // namespace handway::geometric
