#pragma once

#include "app/figures/figure_data.h"

#include <QString>

/// The figures of the paper's section 4 for any hand and basis, each as PNG and SVG.
namespace handway::gui {

/// Six pairs of joints as scatter plots (Fig. 7): the paper's for a hand with its joints,
/// else those that correlate most. Needs two joints that move.
void write_correlation_figure(const FigureData& data, const QString& path);

/// Cumulative variance by the number of directions (Fig. 10).
void write_variance_figure(const FigureData& data, const QString& path);

/// The hand along each of the first two directions, from one side of the box to the other
/// (Fig. 8). Needs a display.
void write_direction_figure(const FigureData& data, const QString& path);

/// The hand over a grid of the first two directions (Fig. 9). Needs a display.
void write_grid_figure(const FigureData& data, const QString& path);

}  // namespace handway::gui
