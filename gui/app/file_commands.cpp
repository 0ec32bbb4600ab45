#include "app/file_commands.h"

#include "app/start/new_scene_dialog.h"
#include "app/start/start_page.h"
#include "features/workbench.h"
#include "handway/geometric/formats/obj_writer.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/resources.h"
#include "view3d/scene_view.h"
#include "widgets/forms/file_dialogs.h"
#include "widgets/panels/log_panel.h"
#include "widgets/style/actions.h"
#include "widgets/style/icons.h"
#include "widgets/style/menu_text.h"

#include <QFileDialog>
#include <QFileIconProvider>
#include <QFileInfo>
#include <QListView>
#include <QMainWindow>
#include <QMessageBox>
#include <QSettings>
#include <QUrl>

#include <algorithm>
#include <map>

namespace handway::gui {
namespace {

constexpr int kMost = 10;

// Some desktops have none.
QKeySequence keys_of(QKeySequence::StandardKey standard, const char* otherwise) {
  const QKeySequence keys(standard);
  return keys.isEmpty() ? QKeySequence(QLatin1String(otherwise)) : keys;
}

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
        addAction(menu_text(QFileInfo(file).fileName()), this, [this, file] { emit chosen(file); });
    action->setToolTip(file);
    action->setStatusTip(file);
  }
  if (isEmpty()) {
    addAction(tr("None yet"))->setEnabled(false);
  }
}

FileCommands::FileCommands(Workbench& workbench)
    : QObject(&workbench),
      workbench_(workbench),
      recent_(new RecentFiles(&workbench.window)),
      open_(workbench.make_action("open", tr("&Open…"), QKeySequence::Open,
                                  tr("Open a scene or problem file"))),
      save_(workbench.make_action("save", tr("&Save"), QKeySequence::Save, tr("Save the scene"))),
      save_as_(workbench.make_action("", tr("Save &as…"),
                                     keys_of(QKeySequence::SaveAs, "Ctrl+Shift+S"),
                                     tr("Save the scene under a name"))),
      picture_(workbench.make_action("camera", tr("Save &picture…"), {},
                                     tr("Save a picture of the 3-D view"))),
      close_(workbench.make_action("", tr("&Close scene"), keys_of(QKeySequence::Close, "Ctrl+W"),
                                   tr("Close the scene and show the start page"))) {
  close_->setObjectName(QStringLiteral("close_scene"));
  place_actions();
  connect(open_, &QAction::triggered, this, &FileCommands::open);
  connect(recent_, &RecentFiles::chosen, &workbench_,
          [this](const QString& file) { workbench_.open(file.toStdString()); });
  connect(save_, &QAction::triggered, this, &FileCommands::save);
  connect(save_as_, &QAction::triggered, this, &FileCommands::save_as);
  connect(picture_, &QAction::triggered, this, &FileCommands::save_picture);
  connect(close_, &QAction::triggered, &workbench_, &Workbench::close);
}

void FileCommands::choose_new() {
  auto* dialog = new NewSceneDialog(&workbench_.window);
  if (const geometric::RobotInstance* robot = workbench_.document.robot()) {
    std::vector<std::string> open{robot->file.string()};
    for (const geometric::RobotPart& part : robot->parts) {
      open.push_back(part.file.string());
    }
    dialog->choose(open);
  }
  connect(dialog, &NewSceneDialog::chosen, &workbench_, &Workbench::create);
  connect(dialog, &NewSceneDialog::file_wanted, &workbench_,
          [this] { workbench_.trigger("open_robot"); });
  dialog->open();
}

void FileCommands::place_actions() {
  QAction* quit =
      workbench_.make_action("", tr("&Quit"), keys_of(QKeySequence::Quit, "Ctrl+Q"), {});
  connect(quit, &QAction::triggered, &workbench_.window, &QWidget::close);
  QAction* create = workbench_.make_action("", tr("&New…"), QKeySequence::New,
                                           tr("Begin a new scene with an arm and a hand"));
  create->setObjectName(QStringLiteral("new_scene"));
  connect(create, &QAction::triggered, this, &FileCommands::choose_new);
  workbench_.add_to_menu(MainMenu::kFile, {0, 0}, create);
  workbench_.add_to_menu(MainMenu::kFile, {0, 1}, open_);
  workbench_.add_to_menu(MainMenu::kFile, {0, 2}, recent_->menuAction());
  workbench_.add_to_menu(MainMenu::kFile, {1, 0}, save_);
  workbench_.add_to_menu(MainMenu::kFile, {1, 1}, save_as_);
  workbench_.add_to_menu(MainMenu::kFile, {1, 2}, picture_);
  workbench_.add_to_menu(MainMenu::kFile, {3, 0}, close_);
  workbench_.add_to_menu(MainMenu::kFile, {3, 1}, quit);
  workbench_.add_to_bar(MainBar::kTools, {0, 0}, open_, true);
  workbench_.add_to_bar(MainBar::kTools, {0, 1}, save_, true);
  workbench_.add_to_bar(MainBar::kTools, {3, 20}, picture_);
}

void FileCommands::show_scene() {
  const Document& document = workbench_.document;
  for (QAction* action : {save_, save_as_, picture_, close_}) {
    allow(*action, document.scene() ? QString() : tr("Open a scene first."));
  }
  if (document.scene() && !document.file().empty()) {
    recent_->add(QString::fromStdString(document.file().string()));
  }
}

namespace {

/// Scenes that ship have their pictures.
class SceneIcons : public QFileIconProvider {
 public:
  SceneIcons() {
    for (const ShippedScene& scene : shipped_scenes()) {
      const QPixmap picture(scene.picture);
      if (!picture.isNull()) {
        pictures_[QString::fromStdString(scene.file.string())] = QIcon(picture);
      }
    }
  }
  using QFileIconProvider::icon;
  [[nodiscard]] QIcon icon(const QFileInfo& file) const override {
    const auto found = pictures_.find(file.absoluteFilePath());
    return found == pictures_.end() ? QFileIconProvider::icon(file) : found->second;
  }

 private:
  std::map<QString, QIcon> pictures_;
};

// The person's, then the folders of the scenes that ship and of those that were opened last.
QList<QUrl> places(QList<QUrl> known) {
  QStringList files = RecentFiles::files();
  for (const ShippedScene& scene : shipped_scenes()) {
    files << QString::fromStdString(scene.file.string());
  }
  for (const QString& file : files) {
    const QUrl folder = QUrl::fromLocalFile(QFileInfo(file).absolutePath());
    if (!known.contains(folder)) {
      known << folder;
    }
  }
  return known;
}

QString dialog_key() { return QStringLiteral("open_dialog"); }

}  // namespace

// The desktop's own dialog has neither pictures nor these places.
void FileCommands::open() {
  constexpr QSize kPicture{96, 60};
  QFileDialog dialog(&workbench_.window, tr("Open a scene"),
                     QFileInfo(QString::fromStdString(workbench_.document.file().string())).path(),
                     tr("Scenes, problems and robots (*.yaml *.yml *.xml *.scene *.urdf *.xacro "
                        "*.sdf *.world *.mjcf);;All files (*)"));
  dialog.setObjectName(QStringLiteral("open_dialog"));
  dialog.setOption(QFileDialog::DontUseNativeDialog);
  dialog.setOption(QFileDialog::HideNameFilterDetails);
  dialog.setFileMode(QFileDialog::ExistingFile);
  const QString folder = dialog.directory().absolutePath();
  dialog.restoreState(QSettings().value(dialog_key()).toByteArray());
  dialog.setDirectory(folder);
  dialog.setSidebarUrls(places(dialog.sidebarUrls()));
  dialog.setViewMode(QFileDialog::List);
  SceneIcons icons;
  dialog.setIconProvider(&icons);
  for (auto* view : dialog.findChildren<QListView*>(QStringLiteral("listView"))) {
    view->setIconSize(kPicture);
  }
  const bool chosen = dialog.exec() == QDialog::Accepted;
  QSettings().setValue(dialog_key(), dialog.saveState());
  if (chosen && !dialog.selectedFiles().isEmpty()) {
    workbench_.open(dialog.selectedFiles().front().toStdString());
  }
}

bool FileCommands::save() {
  const std::filesystem::path& file = workbench_.document.file();
  const bool is_own = geometric::has_extension(file, ".yaml") && !is_shipped(file);
  return is_own ? save_to(QString::fromStdString(file.string())) : save_as();
}

bool FileCommands::save_as() {
  const Document& document = workbench_.document;
  const std::string stem = document.file().empty() ? geometric::file_name_of(document.scene()->name)
                                                   : document.file().stem().string();
  const QString name = QString::fromStdString((stem.empty() ? "scene" : stem) + ".yaml");
  const QString file =
      ask_where_to_save(&workbench_.window, tr("Save the scene"), name, tr("Scenes (*.yaml)"));
  return !file.isEmpty() && save_to(file);
}

// Two windows may have the same scene open.
bool FileCommands::may_overwrite(const QString& file) {
  const Document& document = workbench_.document;
  if (document.file() != file.toStdString() || !document.is_changed_on_disk()) {
    return true;
  }
  return QMessageBox::warning(
             &workbench_.window, tr("The file was changed"),
             tr("Another window or program has changed %1 since it was opened here. Replace its "
                "changes? Save as… keeps both.")
                 .arg(QFileInfo(file).fileName()),
             QMessageBox::Save | QMessageBox::Cancel, QMessageBox::Cancel) == QMessageBox::Save;
}

bool FileCommands::save_to(const QString& file) {
  if (!may_overwrite(file)) {
    return false;
  }
  try {
    workbench_.document.save(file.toStdString(), workbench_.plan_settings.choice());
  } catch (const std::exception& error) {
    workbench_.show_error(tr("The scene was not saved"), QString::fromUtf8(error.what()));
    return false;
  }
  workbench_.editor.undo_stack().setClean();
  recent_->add(file);
  workbench_.log.add(LogPanel::Level::kNote, tr("Saved as %1").arg(file));
  emit saved();
  return true;
}

void FileCommands::save_picture() {
  const QString file =
      ask_where_to_save(&workbench_.window, tr("Save a picture"), {}, tr("Pictures (*.png)"));
  if (!file.isEmpty() && !workbench_.view.picture().save(file)) {
    workbench_.show_error(tr("The picture was not saved"), tr("%1 can't be written").arg(file));
  }
}

bool FileCommands::may_discard() {
  if (!workbench_.editor.is_modified()) {
    return true;
  }
  const auto answer = QMessageBox::question(
      &workbench_.window, tr("Unsaved changes"),
      tr("Save the changes to %1?").arg(workbench_.scene_name()),
      QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, QMessageBox::Save);
  return answer == QMessageBox::Save ? save() : answer == QMessageBox::Discard;
}

}  // namespace handway::gui
