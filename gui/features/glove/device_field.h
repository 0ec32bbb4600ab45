#pragma once

#include <QComboBox>
#include <QString>

namespace handway::gui {

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

}  // namespace handway::gui
