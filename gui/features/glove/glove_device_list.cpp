#include "features/glove/glove_device_list.h"

#include <QDir>
#include <QFileInfo>
#include <QSettings>

namespace handway::gui {
namespace {

constexpr int kMostRecent = 6;

QString key() { return QStringLiteral("glove/recent"); }

// "usb-FTDI_FT232R_USB_UART_A50285BI-if00-port0" for people.
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

QStringList recent_gloves() { return QSettings().value(key()).toStringList(); }

void add_recent_glove(const QString& device) {
  QStringList devices = recent_gloves();
  devices.removeAll(device);
  devices.prepend(device);
  QSettings().setValue(key(), QStringList(devices.mid(0, kMostRecent)));
}

}  // namespace handway::gui
