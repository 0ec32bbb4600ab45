#pragma once

#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/scene/scene.h"
#include "model/meshes/crease_normals.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace handway::gui {

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
  /// The part of the screen (px²) that the box around the mesh may cover for that: then nothing is
  /// much more than two pixels beside its place, which nobody sees while it moves.
  float most_area = 0.0F;
};

/// A mesh as the view draws it.
struct DrawnMesh {
  ShadedMesh fine;
  bool is_solid = false;             ///< As is_solid() says.
  std::vector<CoarserMesh> coarser;  ///< From fine to coarse; none if that doesn't pay.
};

/// @pre the mesh has a vertex.
[[nodiscard]] DrawnMesh prepare_to_draw(const geometric::TriangleMesh& mesh);

/// What is shown of a link: its visual geometry, or, where there is none, that for collisions.
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
