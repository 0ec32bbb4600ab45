#pragma once

class QMainWindow;

namespace handway::gui {

/// Help > Keyboard shortcuts: lists all keys of the menus, the view and the playback bar in a
/// window of its own, with a field to find one.
void show_shortcuts(QMainWindow& window);

}  // namespace handway::gui
