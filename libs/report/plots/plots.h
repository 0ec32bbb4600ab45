#pragma once

#include "handway/report/document/figure.h"
#include "plots/svg_elements.h"

/// Drawings of the kinds of plots. @param width of the drawing; that of a heat map follows from its
/// tiles.
namespace handway::report {

[[nodiscard]] Drawing draw(const XyPlot& plot, double width);
[[nodiscard]] Drawing draw(const BoxPlot& plot, double width);
[[nodiscard]] Drawing draw(const HeatMap& map, double width);

}  // namespace handway::report
