#pragma once

#include "app/figures/film_data.h"

#include <QString>

namespace handway::gui {

/// The paths as rows of pictures (Figs. 14 and 17 of the paper), as PNG and SVG. Needs a display.
void write_film_figure(const FilmData& data, const QString& path);

}  // namespace handway::gui
