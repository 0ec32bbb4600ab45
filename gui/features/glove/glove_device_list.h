#pragma once

#include <QString>
#include <QStringList>

namespace handway::gui {

/// A serial port that a glove may be on.
struct GlovePort {
  QString path;   ///< To be opened: "/dev/ttyUSB0".
  QString label;  ///< For people: with the adapter's name if the system knows it.
};

/// Serial ports of USB adapters and Bluetooth (ttyUSB*, ttyACM*, rfcomm*), each once; those with a
/// name under serial/by-id first, under that name, which stays the same when plugged elsewhere.
/// @param devices folder of the devices.
[[nodiscard]] QList<GlovePort> find_glove_ports(const QString& devices = QStringLiteral("/dev"));

/// Devices and recordings that were connected to, latest first.
[[nodiscard]] QStringList recent_gloves();
void add_recent_glove(const QString& device);

}  // namespace handway::gui
