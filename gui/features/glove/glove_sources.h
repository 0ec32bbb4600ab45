#pragma once

#include <QList>
#include <QString>
#include <QStringList>

namespace handway::gui {

/// A serial port that a glove may be on.
struct GlovePort {
  QString path;   ///< To be opened: "/dev/ttyUSB0".
  QString label;  ///< Displayed, with the adapter's name if the system knows it.
};

/// Returns the serial ports of USB adapters and Bluetooth (ttyUSB*, ttyACM*, rfcomm*), each once;
/// those with a name under serial/by-id first, under that name, which stays the same when plugged
/// elsewhere.
/// @param devices folder of the devices.
[[nodiscard]] QList<GlovePort> find_glove_ports(const QString& devices = QStringLiteral("/dev"));

/// Returns the filter of file dialogs for recordings: all kinds that read_recording() reads.
[[nodiscard]] QString recording_filter();
/// Returns a description of these kinds, for tooltips.
[[nodiscard]] QString recording_kinds();

/// Returns the devices and recordings that were connected to, latest first.
[[nodiscard]] QStringList recent_gloves();
/// Puts a device first among recent_gloves().
void add_recent_glove(const QString& device);

}  // namespace handway::gui
