#pragma once

#include "handway/geometric/mesh/shape.h"
#include "handway/planning/queries/region_draws.h"
#include "view3d/overlay.h"

#include <utility>
#include <vector>

namespace handway::gui {

inline constexpr geometric::Color kPalmColor{0.16F, 0.40F, 0.78F, 1.0F};
inline constexpr geometric::Color kFingertipColor{0.70F, 0.17F, 0.50F, 1.0F};
inline constexpr geometric::Color kStraightColor{0.93F, 0.70F, 0.08F, 1.0F};

/// Translucent clouds of palms and fingertips, and the straight motion with a dot for the middle
/// of each hypercube, as long as there are few.
[[nodiscard]] Drawing make_region_node(const planning::RegionDraws& draws);

inline constexpr geometric::Color kSearchedColor{0.90F, 0.52F, 0.05F, 1.0F};
inline constexpr geometric::Color kGivenUpColor{0.45F, 0.49F, 0.56F, 1.0F};

/// The edges of boxes: of those within `range` of the arm's way in kSearchedColor, of others in
/// kGivenUpColor; of all in the first if the range is empty, start and goal being joined. Two
/// drawings at most, however many there are.
[[nodiscard]] Drawing make_boxes_node(const std::vector<planning::PalmBox>& boxes,
                                      std::pair<double, double> range);

}  // namespace handway::gui
