#pragma once

#include "model/settings/preferences.h"
#include "model/settings/view_colors.h"

#include <QColor>
#include <QString>

class QApplication;

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
  ViewColors view;
};

[[nodiscard]] ThemeColors colors_of(Theme theme);

/// Gives the program Fusion style, palette and style sheet of `theme`.
void apply_theme(QApplication& application, Theme theme);

/// The theme that was applied last.
[[nodiscard]] Theme current_theme();

/// "#rrggbb", for rich text.
[[nodiscard]] QString html(const QColor& color);

}  // namespace handway::gui
