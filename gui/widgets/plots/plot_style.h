#pragma once

#include <QColor>
#include <QFont>
#include <QString>

class QwtPlot;
class QwtText;

/// Common style of all figures: black on white, thin lines, a light grid, one sans-serif font, as
/// journals print them.
namespace handway::gui {

inline const QColor kPlotInk{0x22, 0x26, 0x2b};
inline const QColor kPlotGrid{0xdd, 0xe1, 0xe6};
inline const QColor kPlotOrange{0xd9, 0x6c, 0x1e};

/// Colours of a plot.
struct PlotColors {
  QColor paper{Qt::white};
  QColor ink = kPlotInk;
  QColor grid = kPlotGrid;
};

/// @param size of the letters, points.
[[nodiscard]] QFont plot_font(double size, bool bold = false);

/// Plain text for a plot: Qwt guesses by default whether it is HTML.
/// @param size of the letters, points.
[[nodiscard]] QwtText plot_text(const QString& text, double size, bool bold = false);

/// Makes a new plot look like the others; its axes get these titles.
void style_plot(QwtPlot& plot, const QString& x_title, const QString& y_title);

/// Draws a styled plot in other colours, for the screen.
void color_plot(QwtPlot& plot, const PlotColors& colors);

}  // namespace handway::gui
