#pragma once

#include "playback/path_history.h"

class QTableWidget;

namespace handway::gui {

/// Fills a table with the figures of two paths and by how much the second differs.
void fill_figures(QTableWidget& table, const PathFigures& left, const PathFigures& right);

}  // namespace handway::gui
