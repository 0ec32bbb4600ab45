#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <cstdint>

namespace handway::geometric {

// Closed polyhedra around round shapes, with `segments` vertices around the axis, a multiple of
// four. The polyhedron of a sphere has half as many segments from pole to pole.

/// Vertices: the bottom ring, the top ring, the middles of bottom and top: 2 segments + 2.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT TriangleMesh round_mesh(const Cylinder& cylinder,
                                                               std::uint32_t segments);
/// Vertices: the ring, the middle of the base, the apex: segments + 2.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT TriangleMesh round_mesh(const Cone& cone,
                                                               std::uint32_t segments);
/// Vertices: the rings from bottom to top, the poles: segments (segments / 2 - 1) + 2.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT TriangleMesh round_mesh(const Sphere& sphere,
                                                               std::uint32_t segments);

}  // namespace handway::geometric
