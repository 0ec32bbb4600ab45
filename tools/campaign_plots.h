#pragma once

#include "handway/planning/campaigns/sample_statistics.h"

#include <span>
#include <string>
#include <vector>

/// Drawings of campaigns, as SVG.
namespace handway::tools {

/// A planner's times in a drawing.
struct PlotSeries {
  std::string label;
  std::vector<double> values;  ///< s; of runs without a path infinite.
};

/// How the share of runs that found a path grows with time, on a logarithmic scale.
[[nodiscard]] std::string ecdf_svg(std::span<const PlotSeries> series);

/// Boxes of the finite values side by side, on a logarithmic scale.
[[nodiscard]] std::string box_plot_svg(std::span<const PlotSeries> series);

}  // namespace handway::tools
