#include "features/glove/device_field.h"

#include "features/glove/glove_sources.h"
#include "model/devices/glove_session.h"

#include <QAbstractItemView>
#include <QFileDialog>
#include <QFileInfo>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QStringList>
#include <QTimer>

namespace handway::gui {
namespace {

const char* const kChooseRecording = "choose-recording";

QString shown(const QString& device) {
  return QFileInfo(device).isFile() ? QFileInfo(device).fileName() : device;
}

}  // namespace

DeviceField::DeviceField(QWidget* parent) : QComboBox(parent) {
  setObjectName(QStringLiteral("glove_device"));
  setEditable(true);
  setInsertPolicy(QComboBox::NoInsert);
  setCompleter(nullptr);
  setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  setMinimumContentsLength(12);
  lineEdit()->setPlaceholderText(tr("/dev/ttyUSB0 or host:port"));
  setToolTip(
      tr("A serial port, a network address such as 192.168.0.7:5000, listen://49500 for a "
         "CyberGlove III on WiFi, the built-in emulator, a recording to replay, or the hand that a "
         "camera, a headset, Rokoko Studio or Manus Core sends: udp://5006"));
  connect(this, qOverload<int>(&QComboBox::activated), this, &DeviceField::choose);
  connect(lineEdit(), &QLineEdit::returnPressed, this, &DeviceField::requested);
  refresh();
  const QStringList recent = recent_gloves();
  set_device(recent.isEmpty() ? GloveSession::emulator_name() : recent.front());
}

QString DeviceField::device() const { return currentText().trimmed(); }

void DeviceField::set_device(const QString& device) {
  const QSignalBlocker quiet(this);
  setCurrentIndex(-1);
  setEditText(device);
  lineEdit()->setCursorPosition(0);
}

void DeviceField::showPopup() {
  refresh();
  view()->setMinimumWidth(view()->sizeHintForColumn(0) + 32);
  QComboBox::showPopup();
}

void DeviceField::refresh() {
  const QString before = currentText();
  const QSignalBlocker quiet(this);
  clear();
  addItem(tr("Emulator: no hardware needed"), GloveSession::emulator_name());
  addItem(tr("Replay a recording…"), QLatin1String(kChooseRecording));
  setItemData(count() - 1,
              tr("Plays a file in a loop, like a connected glove. ") + recording_kinds(),
              Qt::ToolTipRole);
  addItem(tr("Hand sent by UDP: port 5006"), QStringLiteral("udp://5006"));
  setItemData(
      count() - 1,
      tr("Landmarks of a camera, joints of OpenXR, frames of Rokoko Studio (JSON v3 or v4), "
         "or ergonomics of Manus Core. The format is recognised."),
      Qt::ToolTipRole);
  const QList<GlovePort> ports = find_glove_ports();
  if (!ports.isEmpty()) {
    insertSeparator(count());
  }
  for (const GlovePort& port : ports) {
    addItem(port.label, port.path);
  }
  QStringList recent = recent_gloves();
  recent.removeAll(GloveSession::emulator_name());
  if (!recent.isEmpty()) {
    insertSeparator(count());
  }
  for (const QString& device : recent) {
    addItem(shown(device), device);
    setItemData(count() - 1, device, Qt::ToolTipRole);
  }
  set_device(before);
}

void DeviceField::choose(int index) {
  const QString device = itemData(index).toString();
  if (device == QLatin1String(kChooseRecording)) {
    set_device({});
    QTimer::singleShot(0, this, &DeviceField::choose_recording);
  } else {
    set_device(device);
  }
}

void DeviceField::choose_recording() {
  const QString file =
      QFileDialog::getOpenFileName(this, tr("Replay a recording"), {}, recording_filter());
  if (!file.isEmpty()) {
    set_device(file);
    emit requested();
  }
}

}  // namespace handway::gui
