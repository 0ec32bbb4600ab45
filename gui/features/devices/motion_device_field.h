#pragma once

#include <QComboBox>

namespace handway::gui {

/// Where an arm or a hand is: none, the built-in emulator, or an address.
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
  /// Puts an address that worked among those to choose from, for next time too.
  void remember();

 private:
  [[nodiscard]] QString key() const;

  QString kind_;
};

}  // namespace handway::gui
