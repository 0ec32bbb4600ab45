#pragma once

#include "handway/geometric/scene/scene.h"
#include "view3d/drawing.h"

namespace handway::gui {

/// Draws the named frames of a scene, red, green and blue for x, y and z, with a dot at the origin.
/// @param q configuration of the first robot, for frames on its links and on what it carries.
[[nodiscard]] Drawing make_frames_node(const geometric::Scene& scene,
                                       const geometric::Configuration& q);

}  // namespace handway::gui
