#pragma once

#include "handway/geometric/scene/color.h"
#include "handway/planning/queries/region_draws.h"
#include "view3d/coin_ref.h"

class SoSeparator;

namespace handway::gui {

inline constexpr geometric::Color kPalmColor{0.16F, 0.40F, 0.78F, 1.0F};
inline constexpr geometric::Color kFingertipColor{0.70F, 0.17F, 0.50F, 1.0F};
inline constexpr geometric::Color kStraightColor{0.93F, 0.70F, 0.08F, 1.0F};

/// Translucent clouds of palms and fingertips, and the straight motion with a dot for the middle
/// of each hypercube, as long as there are few.
[[nodiscard]] CoinRef<SoSeparator> make_region_node(const planning::RegionDraws& draws);

}  // namespace handway::gui
