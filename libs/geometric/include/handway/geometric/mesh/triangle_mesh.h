#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/math/pose.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace handway::geometric {

/// Triangles over shared vertices, in the frame of the body that owns them. Collision checking
/// works on this form of geometry alone.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;                ///< m
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< Indices into `vertices`.

  [[nodiscard]] bool empty() const { return triangles.empty(); }
};

/// An axis-aligned box, m.
struct Aabb {
  Eigen::Vector3d lower;
  Eigen::Vector3d upper;

  [[nodiscard]] Eigen::Vector3d centre() const { return 0.5 * (lower + upper); }
  [[nodiscard]] Eigen::Vector3d size() const { return upper - lower; }
};

/// The tight box around all vertices.
/// @pre the mesh has a vertex.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Aabb bounding_box(const TriangleMesh& mesh);

/// Returns `mesh` with every vertex v replaced by X_AB * (scale ∘ v).
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT TriangleMesh
transformed(const TriangleMesh& mesh, const Pose& X_AB,
            const Eigen::Vector3d& scale = Eigen::Vector3d::Ones());

/// Adds the triangles of `part` to `whole`.
HANDWAY_GEOMETRIC_EXPORT void append(TriangleMesh& whole, const TriangleMesh& part);

/// Returns the triangles with one vertex for each position, also of triangle soups (STL). A
/// triangle may then have a vertex twice.
/// @param grid m: places are merged if they round to the same multiple of it; 0: if equal.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT TriangleMesh welded(const TriangleMesh& mesh,
                                                           double grid = 0.0);

/// For every vertex the number of its piece, from 0: vertices of one piece are connected by
/// triangles. A vertex without triangles is a piece of its own.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::uint32_t> piece_numbers(
    const TriangleMesh& mesh);

/// Returns the triangles without degenerate ones (with a vertex twice) and without duplicates: of
/// faces that are drawn from both sides, one side.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT TriangleMesh distinct_triangles(const TriangleMesh& mesh);

/// Returns whether the surface is watertight, piece by piece: every edge belongs to an even number
/// of triangles, so that it has two sides and separates inside from outside. Triangles may be wound
/// either way.
/// @param mesh welded() and with distinct_triangles(): no two vertices are at the same place.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool is_closed(const TriangleMesh& mesh);

}  // namespace handway::geometric
