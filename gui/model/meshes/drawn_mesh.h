#pragma once

#include "handway/geometric/mesh/triangle_mesh.h"
#include "model/meshes/crease_normals.h"

#include <vector>

namespace handway::gui {

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

/// Returns the mesh with its normals and coarser meshes, ready to draw. @pre it has a vertex.
[[nodiscard]] DrawnMesh prepare_to_draw(const geometric::TriangleMesh& mesh);

}  // namespace handway::gui
