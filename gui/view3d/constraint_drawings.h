#pragma once

#include "handway/geometric/robot/robot_state.h"
#include "handway/geometric/scene/scene.h"
#include "view3d/drawing.h"

namespace handway::gui {

/// Draws the scene's constraints for the first robot at `q`: a cone about the direction that an
/// axis has to keep to, with the axis in it; a box that a point has to stay in, with the point.
/// Violated constraints are red.
[[nodiscard]] Drawing make_constraints_node(const geometric::Scene& scene,
                                            const geometric::Configuration& q);

}  // namespace handway::gui
