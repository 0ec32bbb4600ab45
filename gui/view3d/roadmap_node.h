#pragma once

#include "model/planning/palm_roadmap.h"
#include "view3d/coin_ref.h"

class SoSeparator;

namespace handway::gui {

/// A dot where the palm is in each node, coloured by the number of principal motion
/// directions, and a thin line for each edge.
[[nodiscard]] CoinRef<SoSeparator> make_roadmap_node(const PalmRoadmap& roadmap);

/// The most principal motion directions that a node used; 0 if none did.
[[nodiscard]] int most_pmds(const PalmRoadmap& roadmap);

}  // namespace handway::gui
