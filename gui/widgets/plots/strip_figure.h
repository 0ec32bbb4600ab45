#pragma once

#include "widgets/plots/figure_file.h"

#include <QImage>
#include <QString>

#include <vector>

namespace handway::gui {

/// Pictures side by side under a label; those of all strips of a figure are as many.
struct Strip {
  QString label;  ///< May be empty.
  std::vector<QImage> pictures;
};

/// How large a picture is drawn, pixels at 96 dpi; images have a multiple of it.
inline constexpr QSize kStripFrame{150, 132};
inline constexpr int kStripScale = 3;

/// How large the figure of these strips is. @param frame of one picture.
[[nodiscard]] QSize strips_size(const std::vector<Strip>& strips, const QSize& frame = kStripFrame);

/// Draws strips above each other, as the paper's Figs. 14, 15 and 17.
/// @param strips outlives the result.
[[nodiscard]] DrawFigure draw_strips(const std::vector<Strip>& strips,
                                     const QSize& frame = kStripFrame);

}  // namespace handway::gui
