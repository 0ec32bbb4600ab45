#pragma once

#include "widgets/plots/plot_style.h"
#include "widgets/style/theme.h"

namespace handway::gui {

/// Returns the colours of plots in the window, in the theme that was applied last.
[[nodiscard]] inline PlotColors screen_colors() {
  const ThemeColors colors = colors_of(current_theme());
  return {colors.surface, colors.text, colors.border};
}

}  // namespace handway::gui
