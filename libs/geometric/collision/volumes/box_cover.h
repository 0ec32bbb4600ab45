#pragma once

#include "collision/volumes/primitive_distance.h"
#include "collision/volumes/sphere_bounds.h"
#include "collision/volumes/sphere_tree.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace handway::geometric {

/// Boxes that one closed piece of a surface does not enter: some inside of it, some outside.
/// What hangs together and has a point in one of either kind goes through the surface.
struct BoxCover {
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
  std::vector<BoxCover> pieces;
  bool has_all = false;  ///< Whether they are all pieces that there are.
};

/// The boxes of the widest closed ones of a mesh's pieces.
[[nodiscard]] SurfaceSides make_box_cover(const std::vector<TriangleMesh>& pieces);

/// The boxes of a primitive; there are none outside of it.
[[nodiscard]] SurfaceSides make_box_cover(const PrimitiveDistance& primitive);

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

/// Whether points of surface A lie on both sides of a piece of surface B for sure: then the
/// surfaces cross.
/// @param around it is looked for no farther than this reaches, in A's frame. @param X_BA pose
/// of A's frame in B's.
[[nodiscard]] bool surely_pierces(const SurfacePoints& a, const BoundingSphere& around,
                                  const SurfaceSides& b, const FloatPose& X_BA);

/// A lower bound (m) of the distance of surface A from surface B: how far A's box is inside of
/// a box outside of each of B's pieces; 0 or less if it says nothing.
/// @param centre,half of a box that contains A, along the axes of A's frame, m.
[[nodiscard]] float gap_outside(const Eigen::Vector3f& centre, const Eigen::Vector3f& half,
                                const SurfaceSides& b, const FloatPose& X_BA);

}  // namespace handway::geometric
