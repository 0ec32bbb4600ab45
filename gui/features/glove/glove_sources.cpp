#include "features/glove/glove_sources.h"

#include <QDir>
#include <QFileInfo>
#include <QSettings>

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
      "Recordings of hands (*.csv *.txt *.dat *.json *.jsonl *.mat *.npy *.npz *.h5 *.hdf5 "
      "*.parquet *.db3 *.mcap *.yaml *.yml);;"
      "Tables, of this window and of other programs (*.csv *.txt *.dat);;"
      "Hand landmarks (*.json *.jsonl);;"
      "Arrays and bags (*.mat *.npy *.npz *.h5 *.hdf5 *.parquet *.db3 *.mcap);;"
      "Maps of a table's columns (*.yaml *.yml);;"
      "All files (*)");
}

QString recording_kinds() {
  return QObject::tr(
      "Files are recognised by their contents: recordings of this window, tables with sensor names "
      "or in VirtualHand's order, MATLAB data sets with 'angles' or 'glove', hand landmarks "
      "and messages of OpenXR, Rokoko and Manus as JSON lines. For any other table open a map of "
      "its columns, a small YAML file.");
}

QStringList recent_gloves() { return QSettings().value(key()).toStringList(); }

void add_recent_glove(const QString& device) {
  QStringList devices = recent_gloves();
  devices.removeAll(device);
  devices.prepend(device);
  QSettings().setValue(key(), QStringList(devices.mid(0, kMostRecent)));
}

}  // namespace handway::gui
