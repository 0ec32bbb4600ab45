#pragma once

#include <QByteArray>
#include <QSize>
#include <QString>

#include <functional>
#include <vector>

class QPainter;
class QRectF;
class QwtPlot;

namespace handway::gui {

/// Draws a figure in a rectangle of that size (pixels at 96 dpi), top left at (0, 0).
using DrawFigure = std::function<void(QPainter&, const QSize&)>;

/// Writes a figure as `PATH.png` (300 dpi) and `PATH.svg`, each file whole or not at all.
/// @throws geometric::InputError if one can't be written.
void write_figure(const QString& path, const QString& title, const QSize& size,
                  const DrawFigure& draw);

/// Writes one file, by its ending: `.svg`, or else PNG (300 dpi).
/// @throws geometric::InputError if it can't be written.
void write_picture(const QString& file, const QString& title, const QSize& size,
                   const DrawFigure& draw);

/// What write_picture() would write; needs no GUI thread.
[[nodiscard]] QByteArray picture_bytes(const QString& file, const QString& title, const QSize& size,
                                       const DrawFigure& draw);

/// Replaces a file whole. @throws geometric::InputError if it can't be written.
void write_bytes(const QString& file, const QByteArray& bytes);

/// Draws plots side by side, row by row, all of the same size.
void draw_plots(QPainter& painter, const QSize& size, const std::vector<QwtPlot*>& plots,
                int columns);

}  // namespace handway::gui
