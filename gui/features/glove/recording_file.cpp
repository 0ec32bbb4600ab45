#include "features/glove/recording_file.h"

#include "handway/geometric/io/input_error.h"

#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QString>

namespace handway::gui {

std::filesystem::path new_recording_file(const std::filesystem::path& folder) {
  const QString stem = QDir(QString::fromStdString(folder.string()))
                           .filePath(QDateTime::currentDateTime().toString(
                               QStringLiteral("'glove-'yyyyMMdd-HHmmss")));
  QFile file(stem + QStringLiteral(".csv"));
  for (int i = 2; !file.open(QIODevice::WriteOnly | QIODevice::NewOnly); ++i) {
    if (!file.exists()) {
      throw geometric::InputError({file.fileName().toStdString(), "",
                                   file.errorString().toStdString(), "a file that can be written",
                                   "Look whether the folder is full or locked"});
    }
    file.setFileName(QStringLiteral("%1-%2.csv").arg(stem).arg(i));
  }
  return file.fileName().toStdString();
}

}  // namespace handway::gui
