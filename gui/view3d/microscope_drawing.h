#pragma once

#include "model/planning/microscope.h"
#include "view3d/drawing.h"

namespace handway::gui {

/// Draws the roadmap at the palm as it was at the microscope's step, with the edge in question in
/// front: green if it is free, red if it is not. @pre there is a run.
[[nodiscard]] Drawing make_steps_node(const Microscope& microscope);

}  // namespace handway::gui
