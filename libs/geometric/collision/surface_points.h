#pragma once

#include "handway/geometric/scene/triangle_mesh.h"

#include <array>
#include <cstddef>

namespace handway::geometric {

/// Points all over one piece of a surface, in its frame, m: on the surface there is a way from
/// each of them to every other.
struct SurfacePoints {
  static constexpr std::size_t kCount = 64;

  SurfacePoints() = default;

  /// Far from each other; some are the same where there are too few vertices.
  /// @param piece hangs together and has a vertex, or is the vertices of what does.
  explicit SurfacePoints(const TriangleMesh& piece);

  alignas(64) std::array<float, kCount> x{}, y{}, z{};
};

}  // namespace handway::geometric
