#include "features/export/film_parts.h"

#include "handway/geometric/io/input_error.h"
#include "model/jobs/background.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>
#include <QSysInfo>
#include <QTemporaryDir>

#include <cerrno>
#include <csignal>

namespace handway::gui {
namespace {

// On disks that several machines share, each knows its own.
QString start_of_name() {
  return QStringLiteral(".handway-film-%1-").arg(QSysInfo::machineHostName());
}

bool is_running(qint64 program) {
  return ::kill(static_cast<pid_t>(program), 0) == 0 || errno == EPERM;
}

void remove_leftovers(const QDir& folder) {
  const QString start = start_of_name();
  for (const QString& name :
       folder.entryList({start + QLatin1Char('*')}, QDir::Dirs | QDir::Hidden)) {
    bool is_number = false;
    const qint64 program =
        name.mid(start.size()).section(QLatin1Char('-'), 0, 0).toLongLong(&is_number);
    if (is_number && program > 0 && !is_running(program)) {
      QDir(folder.filePath(name)).removeRecursively();
    }
  }
}

}  // namespace

QString parts_beside(const QString& file) {
  return QFileInfo(file).absoluteDir().filePath(
      start_of_name() + QStringLiteral("%1-XXXXXX").arg(QCoreApplication::applicationPid()));
}

void need_writable(const QTemporaryDir& parts, const QString& file) {
  if (!parts.isValid()) {
    throw geometric::InputError({QFileInfo(file).absolutePath().toStdString(), "",
                                 "a folder that can't be written to",
                                 "a folder that can be written to", ""});
  }
}

void remove_leftovers_beside(const QString& file) {
  run_in_background([folder = QFileInfo(file).absoluteDir()] { remove_leftovers(folder); });
}

}  // namespace handway::gui
