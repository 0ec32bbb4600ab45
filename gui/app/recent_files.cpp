#include "app/recent_files.h"

#include <QFileInfo>
#include <QSettings>

namespace handway::gui {
namespace {

constexpr int kMost = 10;

QString key() { return QStringLiteral("recent_files"); }

}  // namespace

RecentFiles::RecentFiles(QWidget* parent) : QMenu(tr("Open &recent"), parent) {
  connect(this, &QMenu::aboutToShow, this, &RecentFiles::rebuild);
  rebuild();
}

QStringList RecentFiles::files() {
  QStringList found;
  for (const QString& file : QSettings().value(key()).toStringList()) {
    if (QFileInfo::exists(file)) {
      found << file;
    }
  }
  return found;
}

void RecentFiles::add(const QString& file) {
  QSettings settings;
  QStringList files = settings.value(key()).toStringList();
  const QString absolute = QFileInfo(file).absoluteFilePath();
  files.removeAll(absolute);
  files.prepend(absolute);
  settings.setValue(key(), QStringList(files.mid(0, kMost)));
  rebuild();
}

void RecentFiles::rebuild() {
  clear();
  for (const QString& file : files()) {
    QAction* action =
        addAction(QFileInfo(file).fileName(), this, [this, file] { emit chosen(file); });
    action->setToolTip(file);
    action->setStatusTip(file);
  }
  if (isEmpty()) {
    addAction(tr("None yet"))->setEnabled(false);
  }
}

}  // namespace handway::gui
