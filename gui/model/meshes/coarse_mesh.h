#pragma once

#include "handway/geometric/mesh/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace handway::gui {

/// A mesh of some of another one's vertices.
struct CoarseMesh {
  geometric::TriangleMesh mesh;
  std::vector<std::uint32_t> origins;  ///< For every vertex its number in the other mesh.
};

/// Returns a mesh of fewer triangles that stays within about `error` (m) of `mesh`, with the same
/// pieces, borders and holes, by meshoptimizer's quadric error metrics.
/// @param mesh welded.
[[nodiscard]] CoarseMesh coarsened(const geometric::TriangleMesh& mesh, double error);

}  // namespace handway::gui
