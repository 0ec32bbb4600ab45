#pragma once

#include <QComboBox>

namespace handway::gui {

/// Where the glove is: one field that takes a serial port, an address, the emulator or
/// a recording, with those that are known to choose from.
class DeviceField : public QComboBox {
  Q_OBJECT

 public:
  explicit DeviceField(QWidget* parent = nullptr);

  /// As GloveSession::connect_to() takes it.
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

}  // namespace handway::gui
