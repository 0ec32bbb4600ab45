#include "features/devices/motion_device_field.h"

#include <QComboBox>
#include <QLineEdit>
#include <QSettings>
#include <QSignalBlocker>

#include <utility>

namespace handway::gui {
namespace {

constexpr int kMostRecent = 5;

}  // namespace

MotionDeviceField::MotionDeviceField(QString kind, int port, QWidget* parent)
    : QComboBox(parent), kind_(std::move(kind)) {
  setObjectName(kind_ + QStringLiteral("_device"));
  setEditable(true);
  setInsertPolicy(QComboBox::NoInsert);
  setCompleter(nullptr);
  setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  setMinimumContentsLength(12);
  lineEdit()->setPlaceholderText(tr("host or host:port"));
  setToolTip(tr("Address of the controller, such as 192.168.0.254 (default port %1), or the "
                "built-in emulator, which starts in the robot's present configuration")
                 .arg(port));
  addItem(tr("Emulator"), QStringLiteral("emulator"));
  addItem(tr("None"), QStringLiteral("none"));
  for (const QString& address : QSettings().value(key()).toStringList()) {
    addItem(address);
  }
  setCurrentIndex(0);
}

bool MotionDeviceField::is_emulator() const {
  return currentText() == itemText(0) || currentText() == QStringLiteral("emulator");
}

QString MotionDeviceField::address() const {
  const QString text = currentText().trimmed();
  if (is_emulator() || text.isEmpty() || text == itemText(1)) {
    return {};
  }
  return text.contains(QStringLiteral("://")) ? text : kind_ + QStringLiteral("://") + text;
}

void MotionDeviceField::choose(const QString& device) {
  const int known = findData(device);
  if (known >= 0) {
    setCurrentIndex(known);
  } else {
    setCurrentIndex(-1);
    setEditText(device);
  }
}

void MotionDeviceField::remember() {
  if (address().isEmpty()) {
    return;
  }
  const QString text = currentText().trimmed();
  QStringList recent = QSettings().value(key()).toStringList();
  recent.removeAll(text);
  recent.prepend(text);
  recent = recent.mid(0, kMostRecent);
  QSettings().setValue(key(), recent);
  if (findText(text) < 0) {
    const QSignalBlocker quiet(this);
    addItem(text);
    setEditText(text);
  }
}

QString MotionDeviceField::key() const { return QStringLiteral("devices/") + kind_; }

}  // namespace handway::gui
