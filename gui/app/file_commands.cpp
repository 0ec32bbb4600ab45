#include "app/file_commands.h"

#include "handway/geometric/io/existing_file.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
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

FileCommands::FileCommands(QWidget& window, Document& document, PlanSettings& planning,
                           QUndoStack& edits)
    : QObject(&window), window_(window), document_(document), planning_(planning), edits_(edits) {}

QString FileCommands::scene_name() const {
  const std::string& name = document_.scene()->name;
  return QString::fromStdString(!name.empty()              ? name
                                : document_.file().empty() ? tr("New scene").toStdString()
                                                           : document_.file().filename().string());
}

QString FileCommands::choose() {
  return QFileDialog::getOpenFileName(
      &window_, tr("Open a scene"),
      QFileInfo(QString::fromStdString(document_.file().string())).path(),
      tr("Scenes, problems and robots (*.yaml *.yml *.xml *.urdf);;All files (*)"));
}

bool FileCommands::save() {
  const bool is_own = geometric::has_extension(document_.file(), ".yaml");
  return is_own ? save_to(QString::fromStdString(document_.file().string())) : save_as();
}

bool FileCommands::save_as() {
  QString file = QFileDialog::getSaveFileName(
      &window_, tr("Save the scene"),
      QString::fromStdString(document_.file().stem().string() + ".yaml"), tr("Scenes (*.yaml)"));
  if (file.isEmpty()) {
    return false;
  }
  if (QFileInfo(file).suffix().isEmpty()) {
    file += QStringLiteral(".yaml");
  }
  return save_to(file);
}

bool FileCommands::save_to(const QString& file) {
  try {
    document_.save(file.toStdString(), planning_.choice());
  } catch (const std::exception& error) {
    emit failed(tr("The scene was not saved"), QString::fromUtf8(error.what()));
    return false;
  }
  edits_.setClean();
  emit saved(file);
  return true;
}

void FileCommands::save_picture(QWidget& view) {
  const QString file =
      QFileDialog::getSaveFileName(&window_, tr("Save a picture"), {}, tr("Pictures (*.png)"));
  if (!file.isEmpty() && !view.grab().save(file)) {
    emit failed(tr("The picture was not saved"), tr("%1 can't be written").arg(file));
  }
}

bool FileCommands::may_discard() {
  if (edits_.isClean()) {
    return true;
  }
  const auto answer = QMessageBox::question(
      &window_, tr("Unsaved changes"), tr("Save the changes to %1?").arg(scene_name()),
      QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, QMessageBox::Save);
  return answer == QMessageBox::Save ? save() : answer == QMessageBox::Discard;
}

}  // namespace handway::gui
