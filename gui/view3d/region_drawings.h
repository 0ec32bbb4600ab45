#pragma once

#include "handway/geometric/mesh/shape.h"
#include "handway/planning/queries/region_draws.h"
#include "view3d/drawing.h"

#include <utility>
#include <vector>

namespace handway::gui {

inline constexpr geometric::Color kPalmColor{0.16F, 0.40F, 0.78F, 1.0F};
inline constexpr geometric::Color kFingertipColor{0.70F, 0.17F, 0.50F, 1.0F};
inline constexpr geometric::Color kStraightColor{0.93F, 0.70F, 0.08F, 1.0F};

/// Draws translucent clouds of palms and fingertips, and the straight motion with a dot for the
/// middle of each hypercube, as long as there are few.
[[nodiscard]] Drawing make_region_node(const planning::RegionDraws& draws);

inline constexpr geometric::Color kSearchedColor{0.90F, 0.52F, 0.05F, 1.0F};
inline constexpr geometric::Color kGivenUpColor{0.45F, 0.49F, 0.56F, 1.0F};

/// Draws the edges of boxes: kSearchedColor within `range` of the arm's corridor, kGivenUpColor
/// outside. If the range is empty, as start and goal are joined, all are in kSearchedColor. There
/// are at most two nodes, however many boxes there are.
[[nodiscard]] Drawing make_boxes_node(const std::vector<planning::PalmBox>& boxes,
                                      std::pair<double, double> range);

}  // namespace handway::gui
