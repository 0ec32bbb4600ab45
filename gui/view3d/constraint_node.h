#pragma once

#include "handway/geometric/scene/scene.h"
#include "view3d/overlay.h"

namespace handway::gui {

/// The scene's constraints as they are for the first robot at `q`: a cone about the direction that
/// an axis has to keep to, with the axis in it; a box that a point has to stay in, with the point.
/// What is violated is red.
[[nodiscard]] Drawing make_constraints_node(const geometric::Scene& scene,
                                            const geometric::Configuration& q);

}  // namespace handway::gui
