#pragma once

#include "handway/device/glove/glove_calibration.h"

#include <QComboBox>
#include <QString>
#include <QStringList>

#include <optional>

namespace handway::gui {

/// A serial port that a glove may be on.
struct GlovePort {
  QString path;   ///< To be opened: "/dev/ttyUSB0".
  QString label;  ///< Displayed, with the adapter's name if the system knows it.
};

/// Serial ports of USB adapters and Bluetooth (ttyUSB*, ttyACM*, rfcomm*), each once; those with a
/// name under serial/by-id first, under that name, which stays the same when plugged elsewhere.
/// @param devices folder of the devices.
[[nodiscard]] QList<GlovePort> find_glove_ports(const QString& devices = QStringLiteral("/dev"));

/// Returns the filter of file dialogs for recordings: all kinds that read_recording() reads.
[[nodiscard]] QString recording_filter();
/// Returns a description of these kinds, for tooltips.
[[nodiscard]] QString recording_kinds();

/// Devices and recordings that were connected to, latest first.
[[nodiscard]] QStringList recent_gloves();
void add_recent_glove(const QString& device);

/// Field to choose the source of a glove: a serial port, an address, the emulator or a recording,
/// with a list of known ones.
class DeviceField : public QComboBox {
  Q_OBJECT

 public:
  explicit DeviceField(QWidget* parent = nullptr);

  /// Returns the device in the form of GloveSession::connect_to().
  [[nodiscard]] QString device() const;
  void set_device(const QString& device);

  void showPopup() override;

 signals:
  /// The person wants that device now: Enter, or a recording that was chosen.
  void requested();

 private:
  void refresh();
  void choose(int index);
  void choose_recording();
};

/// Field to choose the calibration that converts counts to angles: the typical one, or one from a
/// file.
class CalibrationChoice : public QComboBox {
  Q_OBJECT

 public:
  explicit CalibrationChoice(QWidget* parent = nullptr);

  /// @throws geometric::InputError if it is none.
  void load(const QString& file);

 signals:
  /// Emitted with the chosen calibration; nothing: the typical one.
  void chosen(const std::optional<handway::device::GloveCalibration>& calibration);
  void failed(const QString& message);

 private:
  void choose(int index);

  int last_ = 0;
};

}  // namespace handway::gui
