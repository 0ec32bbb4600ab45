#pragma once

#include "handway/geometric/mesh/shape.h"
#include "model/planning/microscope.h"
#include "model/planning/palm_roadmap.h"
#include "view3d/overlay.h"

namespace handway::gui {

/// What a sample is drawn in that used `count` of at most `most` principal motion
/// directions, from blue for few to magenta for many; grey for none.
[[nodiscard]] geometric::Color pmd_color(int count, int most);

/// A dot where the palm is in each node, coloured by the number of principal motion
/// directions, and a thin line for each edge.
[[nodiscard]] Drawing make_roadmap_node(const PalmRoadmap& roadmap);

/// The most principal motion directions that a node used; 0 if none did.
[[nodiscard]] int most_pmds(const PalmRoadmap& roadmap);

/// The roadmap at the palm as it was at the microscope's step, with the edge in question in
/// front: green if it is free, red if it is not. @pre there is a run.
[[nodiscard]] Drawing make_steps_node(const Microscope& microscope);

}  // namespace handway::gui
