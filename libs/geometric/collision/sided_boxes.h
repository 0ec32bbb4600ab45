#pragma once

#include "collision/primitive_distance.h"
#include "handway/geometric/scene/triangle_mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace handway::geometric {

/// Boxes that one closed piece of a surface does not enter: some inside of it, some outside.
/// What hangs together and has a point in one of either kind goes through the surface.
struct SidedBoxes {
  static constexpr std::size_t kMost = 16;  ///< Boxes of each kind.

  /// Boxes along the axes of a frame P, m, side by side; past the last one, none that anything
  /// is in.
  struct alignas(64) Boxes {
    std::array<std::array<float, kMost>, 3> centre{};
    std::array<std::array<float, kMost>, 3> half{};  ///< Half the edges.
  };

  std::array<float, 9> R_PB;    ///< From the mesh's frame, row by row: faces lie across P's axes.
  std::array<float, 3> centre;  ///< Of a box along P's axes that contains the piece …
  std::array<float, 3> half;    ///< … and half its edges, m.
  Boxes inside;
  Boxes outside;
};

/// What is known of the sides of a whole surface.
struct SurfaceSides {
  std::vector<SidedBoxes> pieces;
  bool has_all = false;  ///< Whether they are all pieces that there are.
};

/// The boxes of the widest closed ones of a mesh's pieces.
[[nodiscard]] SurfaceSides make_sided_boxes(const std::vector<TriangleMesh>& pieces);

/// The boxes of a primitive; there are none outside of it.
[[nodiscard]] SurfaceSides make_sided_boxes(const PrimitiveDistance& primitive);

}  // namespace handway::geometric
