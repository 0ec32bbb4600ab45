#pragma once

#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/scene/scene.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace handway::gui {

/// Returns this surface with coinciding vertices (within a ten-thousandth of a millimetre) merged,
/// also of triangle soups (STL), without degenerate triangles.
[[nodiscard]] geometric::TriangleMesh welded_to_draw(const geometric::TriangleMesh& mesh);

/// Returns whether the mesh is the surface of solids, seen from outside, whose back faces can't be
/// seen: each edge is passed as often one way as the other, and each piece has a volume above 0.
/// @param mesh welded.
[[nodiscard]] bool is_solid(const geometric::TriangleMesh& mesh);

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

/// A mesh of some of another one's vertices.
struct CoarseMesh {
  geometric::TriangleMesh mesh;
  std::vector<std::uint32_t> origins;  ///< For every vertex its number in the other mesh.
};

/// A mesh of fewer triangles that stays within about `error` (m) of `mesh`, with the same pieces,
/// borders and holes, by meshoptimizer's quadric error metrics.
/// @param mesh welded.
[[nodiscard]] CoarseMesh coarsened(const geometric::TriangleMesh& mesh, double error);

/// A coarser mesh that looks like the fine one from afar.
struct CoarserMesh {
  ShadedMesh mesh;
  /// Largest part of the screen (px²) that the box around the mesh may cover for that: then no
  /// point is much more than two pixels off, which is invisible while it moves.
  float most_area = 0.0F;
};

/// A mesh as the view draws it.
struct DrawnMesh {
  ShadedMesh fine;
  bool is_solid = false;             ///< See is_solid().
  std::vector<CoarserMesh> coarser;  ///< From fine to coarse; none if that doesn't pay.
};

/// @pre the mesh has a vertex.
[[nodiscard]] DrawnMesh prepare_to_draw(const geometric::TriangleMesh& mesh);

/// Returns the displayed geometry of a link: its visual geometry or, if there is none, that for
/// collisions.
[[nodiscard]] inline const std::vector<geometric::LinkGeometry>& shown_geometry(
    const geometric::Link& link) {
  return link.visual.empty() ? link.collision : link.visual;
}

/// The mesh made ready to draw, once for each mesh and kept as long as that is. For any thread.
[[nodiscard]] std::shared_ptr<const DrawnMesh> shaded(
    const std::shared_ptr<const geometric::TriangleMesh>& mesh);

/// Makes those of all that a scene shows, so that the GUI thread finds them.
void shade_meshes(const geometric::Scene& scene);

}  // namespace handway::gui
