#pragma once

class QWidget;

namespace handway::gui {

/// Help > About, in front of `window`.
void show_about(QWidget& window);

}  // namespace handway::gui
