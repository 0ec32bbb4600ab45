#include "glove/recording_file.h"

#include "handway/geometric/io/input_error.h"

#include <QDateTime>
#include <QFile>
#include <QString>

#include <string>

namespace handway::gui {

std::filesystem::path new_recording_file(const std::filesystem::path& folder) {
  const QString stem = QStringLiteral("glove-") +
                       QDateTime::currentDateTime().toString(QStringLiteral("yyyyMMdd-HHmmss"));
  std::filesystem::path path = folder / (stem.toStdString() + ".csv");
  QFile file(QString::fromStdString(path.string()));
  for (int i = 2; !file.open(QIODevice::WriteOnly | QIODevice::NewOnly); ++i) {
    if (!file.exists()) {
      throw geometric::InputError({path.string(), "", file.errorString().toStdString(),
                                   "a file that can be written",
                                   "Look whether the folder is full or locked"});
    }
    path = folder / (stem.toStdString() + "-" + std::to_string(i) + ".csv");
    file.setFileName(QString::fromStdString(path.string()));
  }
  return path;
}

}  // namespace handway::gui
