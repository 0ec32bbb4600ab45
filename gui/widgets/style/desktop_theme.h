#pragma once

#include "model/settings/preferences.h"

#include <QPalette>

#include <optional>

class QDBusConnection;

namespace handway::gui {

/// Whether the desktop is light or dark, as it was when the first of desktop_theme() and
/// apply_theme() was called.
Theme desktop_theme();

/// What the desktop answers to applications (GNOME, Plasma and others): `color-scheme` of the
/// freedesktop portal's `org.freedesktop.appearance`; empty if it has no wish or there is no
/// portal.
[[nodiscard]] std::optional<Theme> theme_of_portal(const QDBusConnection& bus);

/// That of the colours that the desktop gives to applications.
[[nodiscard]] Theme theme_of(const QPalette& palette);

}  // namespace handway::gui
