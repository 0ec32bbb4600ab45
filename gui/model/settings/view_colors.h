#pragma once

#include "handway/geometric/mesh/shape.h"

namespace handway::gui {

/// Colours of the 3-D view that go with the window's theme.
struct ViewColors {
  geometric::Color sky{0.78F, 0.83F, 0.89F, 1.0F};     ///< Backdrop, top.
  geometric::Color ground{0.96F, 0.97F, 0.98F, 1.0F};  ///< Backdrop, bottom.
  geometric::Color grid{0.42F, 0.48F, 0.56F, 1.0F};
  geometric::Color text{0.20F, 0.24F, 0.30F, 1.0F};
};

/// What start and goal are drawn in, in the view and in the panels.
inline constexpr geometric::Color kStartColor{0.16F, 0.62F, 0.44F, 1.0F};
inline constexpr geometric::Color kGoalColor{0.92F, 0.52F, 0.16F, 1.0F};

/// Where a search that found no path came to from the start and from the goal.
inline constexpr geometric::Color kFromStartColor{0.13F, 0.45F, 0.86F, 1.0F};
inline constexpr geometric::Color kFromGoalColor{0.62F, 0.25F, 0.74F, 1.0F};

/// A path that gets better, while it does.
inline constexpr geometric::Color kOptimizedColor{0.10F, 0.55F, 0.95F, 1.0F};

}  // namespace handway::gui
