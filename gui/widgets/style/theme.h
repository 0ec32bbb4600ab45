#pragma once

#include "model/settings/options.h"
#include "model/settings/preferences.h"

#include <QColor>
#include <QIcon>
#include <QString>

#include <functional>

class QApplication;
class QWidget;

class QAction;
class QKeySequence;
class QObject;
class QPainter;

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

/// "#rrggbb", for rich text.
[[nodiscard]] QString html(const QColor& color);

/// Plain text as rich text in a colour.
[[nodiscard]] QString colored(const QString& text, const QColor& color);
/// Plain text as rich text behind a dot in a colour: how something is.
[[nodiscard]] QString dotted(const QString& text, const QColor& color);

/// The ratio of two colours' luminances, 1 to 21, as the Web Content Accessibility Guidelines 2.1
/// define it.
[[nodiscard]] double contrast(const QColor& a, const QColor& b);

/// `from`, with a share of its way to `to`.
[[nodiscard]] QColor mixed(const QColor& from, const QColor& to, double share);

/// `color`, lighter or darker if it could hardly be distinguished from `background`.
[[nodiscard]] QColor seen_on(const QColor& background, const QColor& color);

/// Calls `take`, at once and whenever the widget gets another theme.
void follow_theme(QWidget& widget, std::function<void()> take);

/// Sets another role in the style sheet for a widget that is already shown; empty: none.
void set_role(QWidget& widget, const QString& role);

/// Returns the colour of what needs attention but is no fault: joints at their limits, sensors at
/// their ends.
[[nodiscard]] inline QColor attention_color() {
  return current_theme() == Theme::kDark ? QColor(0xe5, 0xa5, 0x3d) : QColor(0x8f, 0x56, 0x00);
}

/// `color` with a part of its opacity.
[[nodiscard]] inline QColor faded(QColor color, double opacity) {
  color.setAlphaF(opacity);
  return color;
}

/// The icon resources/icons/NAME.svg in the current theme's colours: muted text
/// colour at rest, accent when checked, faint when disabled.
[[nodiscard]] QIcon icon(const QString& name);

/// Returns the icon in one given colour.
[[nodiscard]] QIcon icon(const QString& name, const QColor& color);

/// A command with its keys, whose tool tip names them. @param name of the object and of its icon,
/// which is for the caller to set; may be empty. @param tip empty: none.
[[nodiscard]] QAction* make_action(QObject& parent, const QString& name, const QString& text,
                                   const QKeySequence& keys, const QString& tip);

/// Enables a command of make_action(), or disables it, with the reason in its tool tip and in the
/// status bar. @param why_not and what to do; empty: it is possible.
void allow(QAction& action, const QString& why_not);

}  // namespace handway::gui
