#pragma once

#include "model/settings/options.h"
#include "model/settings/preferences.h"

#include <QColor>

#include <functional>

class QApplication;
class QPainter;
class QString;
class QWidget;

namespace handway::gui {

/// The few colours that everything else is made of.
struct ThemeColors {
  QColor window;   ///< Behind panels.
  QColor surface;  ///< Panels, fields.
  QColor border;
  QColor text;
  QColor muted;  ///< Secondary text, icons at rest.
  QColor accent;
  QColor on_accent;
  QColor good;
  QColor bad;
  QColor stop;  ///< Behind white words.
  ViewColors view;
};

[[nodiscard]] ThemeColors colors_of(Theme theme);

/// Sets Fusion style, palette and style sheet of `theme`.
/// @param text_scale 1 is 100 %; widgets that exist keep the widths that they have.
void apply_theme(QApplication& application, Theme theme, double text_scale);
/// Sets the theme with the present size of text.
void apply_theme(QApplication& application, Theme theme);

/// Returns a length for text, px: `pixels` at 100 %, scaled with the size of the text.
[[nodiscard]] int scaled(int pixels);
/// Text of so many pixels, as scaled(), for what is painted from now on.
void set_text_size(QPainter& painter, int pixels);

/// The theme that was applied last.
[[nodiscard]] Theme current_theme();

/// Calls `take`, at once and whenever the widget gets another theme.
void follow_theme(QWidget& widget, std::function<void()> take);

/// Sets another role in the style sheet for a widget that is already shown; empty: none.
void set_role(QWidget& widget, const QString& role);

/// Returns the colour of what needs attention but is no fault: joints at their limits, sensors at
/// their ends.
[[nodiscard]] inline QColor attention_color() {
  return current_theme() == Theme::kDark ? QColor(0xe5, 0xa5, 0x3d) : QColor(0x8f, 0x56, 0x00);
}

}  // namespace handway::gui
