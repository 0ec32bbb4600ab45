#pragma once

#include "handway/geometric/mesh/shape.h"
#include "model/planning/palm_roadmap.h"
#include "view3d/drawing.h"

namespace handway::gui {

/// Returns the colour of a sample that used `count` of at most `most` principal motion directions,
/// from blue for few to magenta for many; grey for none.
[[nodiscard]] geometric::Color pmd_color(int count, int most);

/// Returns the most principal motion directions that a node used; 0 if none did.
[[nodiscard]] int most_pmds(const PalmRoadmap& roadmap);

/// Draws a dot where the palm is in each node, coloured by the number of principal motion
/// directions, and a thin line for each edge.
[[nodiscard]] Drawing make_roadmap_node(const PalmRoadmap& roadmap);

}  // namespace handway::gui
