#pragma once

class QMainWindow;
class QWidget;

namespace handway::gui {

/// Help > About, in front of `window`.
void show_about(QWidget& window);

/// F1: says in a small card what the panel under the pointer, or the one with the
/// keyboard, is for.
void show_panel_help(QMainWindow& window);

}  // namespace handway::gui
