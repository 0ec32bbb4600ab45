#pragma once

#include <QLatin1String>
#include <QObject>

namespace handway::gui {

/// Gives an object the name by which tests, scripts and kept settings find it.
template <typename Object>
[[nodiscard]] Object* named(const char* name, Object* object) {
  object->setObjectName(QLatin1String(name));
  return object;
}

}  // namespace handway::gui
