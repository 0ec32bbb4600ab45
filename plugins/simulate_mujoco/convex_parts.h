#pragma once

#include "handway/geometric/mesh/triangle_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace handway::simulate_mujoco {

/// A convex part of a body: the corners of its hull (m) and the hull's volume (m³).
struct ConvexPart {
  std::vector<Eigen::Vector3d> corners;
  double volume = 0.0;
};

/// Limits of a decomposition into convex parts.
struct ConvexPartsLimits {
  /// m: what a part may have beyond the solid, its volume spread over the part's surface.
  double depth = 2e-4;
  int most = 32;  ///< Parts, at least 1. Connected pieces of the mesh are never joined for it.
};

/// Returns convex parts that together cover the mesh. Cuts by planes divide it, the part first
/// whose hull has the most volume beyond its own. Of planes through the part's middle and of those
/// in which many of its corners lie, the one is taken that leaves the least. A cut solid is closed
/// by the cut's face, so that volumes stay true. Of an open surface, which has no volume, the parts
/// cover the triangles.
[[nodiscard]] std::vector<ConvexPart> convex_parts(const geometric::TriangleMesh& mesh,
                                                   const ConvexPartsLimits& limits = {});

/// convex_parts(), from the user's cache if this mesh was divided before: it takes up to a second
/// for the links of a hand. For any thread.
[[nodiscard]] std::vector<ConvexPart> cached_convex_parts(const geometric::TriangleMesh& mesh,
                                                          const ConvexPartsLimits& limits = {});

/// Returns the volume (m³) inside a closed mesh, whichever way its triangles are wound.
[[nodiscard]] double enclosed_volume(const geometric::TriangleMesh& mesh);

}  // namespace handway::simulate_mujoco
