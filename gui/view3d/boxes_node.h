#pragma once

#include "handway/geometric/scene/color.h"
#include "handway/planning/queries/palm_boxes.h"
#include "view3d/coin_ref.h"

#include <utility>
#include <vector>

class SoSeparator;

namespace handway::gui {

inline constexpr geometric::Color kSearchedColor{0.90F, 0.52F, 0.05F, 1.0F};
inline constexpr geometric::Color kGivenUpColor{0.45F, 0.49F, 0.56F, 1.0F};

/// The edges of boxes: of those within `range` of the arm's way in kSearchedColor, of others in
/// kGivenUpColor; of all in the first if the range is empty, start and goal being joined. Two
/// drawings at most, however many there are.
[[nodiscard]] CoinRef<SoSeparator> make_boxes_node(const std::vector<planning::PalmBox>& boxes,
                                                   std::pair<double, double> range);

}  // namespace handway::gui
