#pragma once

#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/scene/scene.h"
#include "model/meshes/drawn_mesh.h"

#include <memory>
#include <vector>

namespace handway::gui {

/// Returns the displayed geometry of a link: its visual geometry or, if there is none, that for
/// collisions.
[[nodiscard]] inline const std::vector<geometric::LinkGeometry>& shown_geometry(
    const geometric::Link& link) {
  return link.visual.empty() ? link.collision : link.visual;
}

/// Returns the mesh ready to draw: it is made once for each mesh and kept as long as that is. For
/// any thread.
[[nodiscard]] std::shared_ptr<const DrawnMesh> shaded(
    const std::shared_ptr<const geometric::TriangleMesh>& mesh);

/// Makes all meshes that a scene shows ready to draw, so that the GUI thread finds them.
void shade_meshes(const geometric::Scene& scene);

}  // namespace handway::gui
