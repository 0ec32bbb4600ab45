#pragma once

#include "model/settings/preferences.h"

#include <QPalette>

#include <optional>

class QDBusConnection;

namespace handway::gui {

/// Returns whether the desktop is light or dark; the first answer is kept.
[[nodiscard]] Theme desktop_theme();

/// The colours that the desktop gave to applications, as they were when this was first called:
/// apply_theme() does before it puts others in their place.
const QPalette& desktop_palette();

/// Returns the desktop's answer to applications (GNOME, Plasma and others): `color-scheme` of the
/// freedesktop portal's `org.freedesktop.appearance`; empty if it has no preference or there is no
/// portal.
[[nodiscard]] std::optional<Theme> theme_of_portal(const QDBusConnection& bus);

/// Returns the theme of an application's colours.
[[nodiscard]] Theme theme_of(const QPalette& palette);

}  // namespace handway::gui
