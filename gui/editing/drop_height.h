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

/// How far an object that stands in the world can sink until it stands on another
/// object or on the floor (z = 0), m; negative: it is to be lifted.
[[nodiscard]] double drop_height(const geometric::Scene& scene,
                                 const geometric::SceneObject& object);

}  // namespace handway::gui
