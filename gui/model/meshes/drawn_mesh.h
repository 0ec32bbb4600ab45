#pragma once

#include "model/meshes/crease_normals.h"

#include <vector>

namespace handway::gui {

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

}  // namespace handway::gui
