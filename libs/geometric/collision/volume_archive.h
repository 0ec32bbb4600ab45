#pragma once

#include "collision/clearance_field.h"
#include "collision/convex_cover.h"
#include "collision/sided_boxes.h"
#include "collision/sphere_cover.h"
#include "collision/surface_points.h"

#include <string>
#include <vector>

namespace handway::geometric {

/// What takes long to make of a mesh.
struct MeshVolumes {
  SphereCover cover;
  ConvexCover hull;
  ClearanceField field;
  SurfaceSides sides;
  SurfacePoints points;
};

/// What changes where the bytes of archived volumes do: a part of their key.
[[nodiscard]] std::string archive_layout();

/// Volumes as bytes, for this kind of processor.
[[nodiscard]] std::string archive_volumes(const MeshVolumes& volumes);

/// @pre `bytes` are what archive_volumes() gave.
[[nodiscard]] MeshVolumes unarchive_volumes(const std::string& bytes);

}  // namespace handway::geometric
