#include "widgets/style/desktop_theme.h"

#include <QApplication>
#include <QDBusConnection>
#include <QDBusMessage>
#include <QDBusVariant>
#include <QFile>
#include <QStandardPaths>

namespace handway::gui {
namespace {

// Without a session's bus, libdbus would start one.
bool has_session_bus() {
  const QString folder = QStandardPaths::writableLocation(QStandardPaths::RuntimeLocation);
  return qEnvironmentVariableIsSet("DBUS_SESSION_BUS_ADDRESS") ||
         QFile::exists(folder + QStringLiteral("/bus"));
}

}  // namespace

Theme desktop_theme() {
  static const Theme kTheme = [] {
    const std::optional<Theme> wish =
        has_session_bus() ? theme_of_portal(QDBusConnection::sessionBus()) : std::nullopt;
    return wish.value_or(theme_of(desktop_palette()));
  }();
  return kTheme;
}

const QPalette& desktop_palette() {
  static const QPalette kPalette = QApplication::palette();
  return kPalette;
}

std::optional<Theme> theme_of_portal(const QDBusConnection& bus) {
  constexpr int kPatienceMs = 500;
  constexpr uint kPrefersDark = 1, kPrefersLight = 2;
  QDBusMessage question = QDBusMessage::createMethodCall(
      QStringLiteral("org.freedesktop.portal.Desktop"),
      QStringLiteral("/org/freedesktop/portal/desktop"),
      QStringLiteral("org.freedesktop.portal.Settings"), QStringLiteral("Read"));
  question << QStringLiteral("org.freedesktop.appearance") << QStringLiteral("color-scheme");
  QVariant answer = bus.call(question, QDBus::Block, kPatienceMs).arguments().value(0);
  while (answer.canConvert<QDBusVariant>()) {  // one in another, as the portal has it
    answer = answer.value<QDBusVariant>().variant();
  }
  switch (answer.toUInt()) {
    case kPrefersDark:
      return Theme::kDark;
    case kPrefersLight:
      return Theme::kLight;
    default:
      return std::nullopt;
  }
}

Theme theme_of(const QPalette& palette) {
  const auto lightness = [&palette](QPalette::ColorRole role) {
    return palette.color(role).lightnessF();
  };
  return lightness(QPalette::WindowText) > lightness(QPalette::Window) ? Theme::kDark
                                                                       : Theme::kLight;
}

}  // namespace handway::gui
