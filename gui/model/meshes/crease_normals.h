#pragma once

#include "handway/geometric/mesh/triangle_mesh.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace handway::gui {

/// A mesh to draw: every vertex has one normal; sharp edges have their vertices twice.
struct ShadedMesh {
  std::vector<Eigen::Vector3f> vertices;                ///< m
  std::vector<Eigen::Vector3f> normals;                 ///< Unit length, one per vertex.
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< Indices into both.
};

/// Gives `mesh` normals that are smooth where neighbouring triangles meet at
/// less than `crease_angle` (rad) and sharp elsewhere. Vertices at the same
/// place count as one, so that triangle soups (STL) come out smooth too;
/// triangles without area are left out.
[[nodiscard]] ShadedMesh with_crease_normals(const geometric::TriangleMesh& mesh,
                                             double crease_angle);

/// Gives a coarser mesh the normals that `fine` has there: those of its triangles around a vertex
/// that look the same way as the coarser triangle, by less than `crease_angle`.
/// @param origins for every vertex of `mesh` one of `fine`, both welded.
[[nodiscard]] ShadedMesh with_normals_of(const geometric::TriangleMesh& fine,
                                         const geometric::TriangleMesh& mesh,
                                         const std::vector<std::uint32_t>& origins,
                                         double crease_angle);

}  // namespace handway::gui
