#pragma once

#include "model/settings/preferences.h"

#include <QPalette>

#include <optional>

class QDBusConnection;

namespace handway::gui {

/// Whether the desktop is light or dark, as it was when this was first asked.
[[nodiscard]] Theme desktop_theme();

/// The colours that the desktop gave to applications, as they were when this was first called:
/// apply_theme() does before it puts others in their place.
const QPalette& desktop_palette();

/// What the desktop answers to applications (GNOME, Plasma and others): `color-scheme` of the
/// freedesktop portal's `org.freedesktop.appearance`; empty if it has no wish or there is no
/// portal.
[[nodiscard]] std::optional<Theme> theme_of_portal(const QDBusConnection& bus);

/// That of the colours of an application.
[[nodiscard]] Theme theme_of(const QPalette& palette);

}  // namespace handway::gui
