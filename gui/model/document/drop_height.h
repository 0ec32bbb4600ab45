#pragma once

#include "handway/geometric/scene/scene.h"
#include "handway/geometric/scene/triangle_mesh.h"

#include <optional>

namespace handway::gui {

/// How far `upper` can sink along -z until it touches `lower`; both in the world.
/// Negative if it must be lifted because they overlap. Nothing if they are not
/// above each other anywhere. Exact for triangles: the least vertical distance is
/// found at a vertex over a face, a face over a vertex, or where two edges cross
/// in the view from above. Of `lower`, only what is not higher than the middle of
/// `upper` counts.
[[nodiscard]] std::optional<double> vertical_gap(const geometric::TriangleMesh& upper,
                                                 const geometric::TriangleMesh& lower);

/// The least vertical gap between an object that stands in the world and those of the scene
/// that it is above, m; negative where they overlap. Nothing if it is above none.
/// @param scene what is attached in it, and an object of that name, do not count.
[[nodiscard]] std::optional<double> gap_to_support(const geometric::Scene& scene,
                                                   const geometric::SceneObject& object);

/// From the floor (z = 0) to the lowest point of an object that stands in the world, m.
[[nodiscard]] double height_above_floor(const geometric::SceneObject& object);

}  // namespace handway::gui
