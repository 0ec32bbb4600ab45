#pragma once

#include <QComboBox>
#include <QWidget>

class QComboBox;

namespace handway::gui {

/// Field to choose the device of an arm or a hand: none, the built-in emulator, or an address.
class MotionDeviceField : public QComboBox {
  Q_OBJECT

 public:
  /// @param kind "arm" or "hand". @param port that it usually listens on.
  MotionDeviceField(QString kind, int port, QWidget* parent = nullptr);

  [[nodiscard]] bool is_emulator() const;
  /// "arm://HOST:PORT"; empty for none and the emulator.
  [[nodiscard]] QString address() const;
  /// "none", "emulator" or an address. For tests and options.
  void choose(const QString& device);
  /// Adds an address that worked to the choices, also for the next start.
  void remember();

 private:
  [[nodiscard]] QString key() const;

  QString kind_;
};

}  // namespace handway::gui
