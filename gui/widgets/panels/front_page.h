#pragma once

class QWidget;

namespace handway::gui {

/// Turns the pages of all tabs that `widget` is in so that it is in front, and shows its dock.
void bring_to_front(const QWidget& widget);

}  // namespace handway::gui
