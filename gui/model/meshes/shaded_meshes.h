#pragma once

#include "handway/geometric/scene/scene.h"
#include "model/meshes/drawn_mesh.h"

#include <memory>

namespace handway::gui {

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
