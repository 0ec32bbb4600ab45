#pragma once

#include <QByteArray>
#include <QImage>
#include <QSize>
#include <QString>

#include <functional>
#include <vector>

class QPainter;
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

/// Returns the bytes that write_picture() would write; needs no GUI thread.
[[nodiscard]] QByteArray picture_bytes(const QString& file, const QString& title, const QSize& size,
                                       const DrawFigure& draw);

/// Replaces a file whole. @throws geometric::InputError if it can't be written.
void write_bytes(const QString& file, const QByteArray& bytes);

/// Draws a plot that fills a figure.
void draw_plot(QPainter& painter, const QSize& size, QwtPlot& plot);

/// Pictures side by side under a label; those of all strips of a figure are as many.
struct Strip {
  QString label;  ///< May be empty.
  std::vector<QImage> pictures;
};

/// Size of a picture, pixels at 96 dpi; images have a multiple of it.
inline constexpr QSize kStripFrame{150, 132};
inline constexpr int kStripScale = 3;

/// Returns the size of the figure of these strips. @param frame of one picture.
[[nodiscard]] QSize strips_size(const std::vector<Strip>& strips, const QSize& frame = kStripFrame);

/// Draws strips above each other, as the paper's Figs. 14, 15 and 17.
/// @param strips outlives the result.
[[nodiscard]] DrawFigure draw_strips(const std::vector<Strip>& strips,
                                     const QSize& frame = kStripFrame);

}  // namespace handway::gui
