#include "features/glove/device_field.h"

#include "model/devices/glove_session.h"

#include <QAbstractItemView>
#include <QCompleter>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QLineEdit>
#include <QSettings>
#include <QSignalBlocker>
#include <QTimer>

#include <exception>

namespace handway::gui {
namespace {

constexpr int kMostRecent = 6;

QString key() { return QStringLiteral("glove/recent"); }

// Returns the displayed name of "usb-FTDI_FT232R_USB_UART_A50285BI-if00-port0".
QString adapter_name(QString id) {
  id.remove(QStringLiteral("usb-"));
  id.truncate(id.indexOf(QStringLiteral("-if")) < 0 ? id.size()
                                                    : id.indexOf(QStringLiteral("-if")));
  return id.replace(QLatin1Char('_'), QLatin1Char(' '));
}

}  // namespace

QList<GlovePort> find_glove_ports(const QString& devices) {
  QList<GlovePort> ports;
  QStringList known;
  const QDir by_id(devices + QStringLiteral("/serial/by-id"));
  for (const QFileInfo& entry : by_id.entryInfoList(QDir::System | QDir::Files, QDir::Name)) {
    const QFileInfo target(entry.canonicalFilePath());
    known << target.fileName();
    ports.append(
        {entry.absoluteFilePath(),
         QStringLiteral("%1  (%2)").arg(adapter_name(entry.fileName()), target.fileName())});
  }
  const QDir folder(devices);
  const QStringList patterns{QStringLiteral("ttyUSB*"), QStringLiteral("ttyACM*"),
                             QStringLiteral("rfcomm*")};
  for (const QFileInfo& entry :
       folder.entryInfoList(patterns, QDir::System | QDir::Files, QDir::Name)) {
    if (!known.contains(entry.fileName())) {
      ports.append({entry.absoluteFilePath(), entry.absoluteFilePath()});
    }
  }
  return ports;
}

QString recording_filter() {
  return QObject::tr(
      "Recordings of hands (*.csv *.txt *.dat *.json *.jsonl *.mat *.yaml *.yml);;"
      "Tables, of this window and of other programs (*.csv *.txt *.dat);;"
      "Hand landmarks (*.json *.jsonl);;"
      "MATLAB data sets (*.mat);;"
      "Maps of a table's columns (*.yaml *.yml);;"
      "All files (*)");
}

QString recording_kinds() {
  return QObject::tr(
      "Files are recognised by their contents: recordings of this window, tables with sensor names "
      "or in VirtualHand's order, MATLAB data sets with 'angles' or 'glove', hand landmarks as "
      "JSON lines. For any other table open a map of its columns, a small YAML file.");
}

QStringList recent_gloves() { return QSettings().value(key()).toStringList(); }

void add_recent_glove(const QString& device) {
  QStringList devices = recent_gloves();
  devices.removeAll(device);
  devices.prepend(device);
  QSettings().setValue(key(), QStringList(devices.mid(0, kMostRecent)));
}

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
         "CyberGlove III on WiFi, the built-in emulator, a recording to replay, or hand landmarks "
         "that a camera or headset sends: udp://5006"));
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

namespace {

constexpr int kTypical = 0;

}  // namespace

CalibrationChoice::CalibrationChoice(QWidget* parent) : QComboBox(parent) {
  setObjectName(QStringLiteral("glove_calibration"));
  setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  setMinimumContentsLength(10);
  addItem(tr("Typical right hand"));
  addItem(tr("From a file…"));
  setItemData(kTypical, tr("Generic calibration"), Qt::ToolTipRole);
  connect(this, qOverload<int>(&QComboBox::activated), this, &CalibrationChoice::choose);
}

void CalibrationChoice::load(const QString& file) {
  const device::GloveCalibration calibration = device::read_calibration(file.toStdString());
  int index = findData(file);
  if (index < 0) {
    index = count() - 1;
    insertItem(index, QFileInfo(file).fileName(), file);
  }
  setCurrentIndex(index);
  last_ = index;
  emit chosen(calibration);
}

void CalibrationChoice::choose(int index) {
  if (index == kTypical) {
    last_ = kTypical;
    emit chosen(std::nullopt);
    return;
  }
  QString file = itemData(index).toString();
  if (file.isEmpty()) {
    setCurrentIndex(last_);
    file = QFileDialog::getOpenFileName(this, tr("Open a calibration"), {},
                                        tr("Calibrations (*.yaml *.cal *.txt);;All files (*)"));
  }
  if (file.isEmpty()) {
    return;
  }
  try {
    load(file);
  } catch (const std::exception& error) {
    setCurrentIndex(last_);
    emit failed(QString::fromUtf8(error.what()));
  }
}

}  // namespace handway::gui
