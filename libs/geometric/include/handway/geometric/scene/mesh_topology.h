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

/// The same triangles without those that have a vertex twice, and one of those that have the same
/// three: of faces that are drawn from both sides, one side.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT TriangleMesh distinct_triangles(const TriangleMesh& mesh);

/// Whether the surface is watertight, piece by piece: every edge belongs to an even number of
/// triangles, so that it has two sides and whoever gets from one to the other goes through it.
/// Triangles may be wound either way.
/// @param mesh welded() and with distinct_triangles(): no two vertices are at the same place.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool is_closed(const TriangleMesh& mesh);

}  // namespace handway::geometric
