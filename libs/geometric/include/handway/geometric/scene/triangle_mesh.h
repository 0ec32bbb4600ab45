#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/math/pose.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace handway::geometric {

/// Triangles over shared vertices, in the frame of the body that owns them.
/// The one geometric form that collision checking works on.
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

/// `mesh` with every vertex v replaced by X_AB * (scale ∘ v).
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT TriangleMesh
transformed(const TriangleMesh& mesh, const Pose& X_AB,
            const Eigen::Vector3d& scale = Eigen::Vector3d::Ones());

/// Adds the triangles of `part` to `whole`.
HANDWAY_GEOMETRIC_EXPORT void append(TriangleMesh& whole, const TriangleMesh& part);

}  // namespace handway::geometric
