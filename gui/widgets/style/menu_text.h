#pragma once

#include <QString>

#include <string>

namespace handway::gui {

/// Returns a name as the text of a menu entry or a button, in which an ampersand is a letter and
/// not the mark of a mnemonic.
[[nodiscard]] inline QString menu_text(QString name) {
  return name.replace(QLatin1Char('&'), QLatin1String("&&"));
}
[[nodiscard]] inline QString menu_text(const std::string& name) {
  return menu_text(QString::fromStdString(name));
}

}  // namespace handway::gui
