#include "features/robots/add_robot_dialog.h"

#include "handway/geometric/formats/urdf.h"
#include "handway/geometric/io/package_path.h"
#include "handway/geometric/io/resources.h"
#include "handway/planning/edits/scene_edits.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "model/meshes/shaded_meshes.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/pose_form.h"
#include "widgets/panels/dock_layout.h"
#include "widgets/panels/xacro_dialog.h"
#include "widgets/style/icons.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSettings>
#include <QSignalBlocker>

#include <algorithm>
#include <utility>

namespace handway::gui {
namespace {

using geometric::ResourceKind;
using geometric::RobotInstance;

constexpr int kLinkRole = Qt::UserRole + 1;
constexpr int kWidth = 500;  // px

QString path_key() { return QStringLiteral("package_path"); }

QString folder_key() { return QStringLiteral("robot_folder"); }

// @returns empty if the user cancels. @param filter empty: for a folder.
QString ask_for(QWidget* parent, const QString& title, const QString& filter) {
  QFileDialog dialog(parent, title, QSettings().value(folder_key()).toString(), filter);
  dialog.setObjectName(QStringLiteral("robot_file_dialog"));
  dialog.setOption(QFileDialog::DontUseNativeDialog);
  dialog.setFileMode(filter.isEmpty() ? QFileDialog::Directory : QFileDialog::ExistingFile);
  return dialog.exec() == QDialog::Accepted && !dialog.selectedFiles().isEmpty()
             ? dialog.selectedFiles().front()
             : QString();
}

// A robot that a scene is made of already is one robot from here on.
RobotInstance read_robot(const std::filesystem::path& file,
                         const geometric::XacroArguments& arguments,
                         const planning::PluginManager& plugins) {
  const planning::SceneState loaded = planning::load_scene(file, plugins, arguments);
  RobotInstance robot = loaded.scene->robots.front();
  if (!robot.parts.empty()) {
    robot.parts.clear();
    robot.file.clear();
  }
  robot.X_WB = geometric::Pose::Identity();
  shade_meshes(*loaded.scene);
  return robot;
}

}  // namespace

QString choose_robot_file(QWidget* parent) {
  const QString file =
      ask_for(parent, AddRobotDialog::tr("Choose a robot"),
              AddRobotDialog::tr(
                  "Robots (*.urdf *.xacro *.sdf *.world *.mjcf *.xml *.yaml);;All files (*)"));
  if (!file.isEmpty()) {
    QSettings().setValue(folder_key(), QFileInfo(file).absolutePath());
  }
  return file;
}

void use_package_path() {
  for (const QString& folder : QSettings().value(path_key()).toStringList()) {
    geometric::add_package_path(folder.toStdString());
  }
}

void remember_package_path(const QString& folder) {
  QStringList folders = QSettings().value(path_key()).toStringList();
  folders.removeAll(folder);
  QSettings().setValue(path_key(), folders << folder);
  geometric::add_package_path(folder.toStdString());
}

AddRobotDialog::AddRobotDialog(std::shared_ptr<const planning::PluginManager> plugins,
                               SceneEditor& editor, FreePlace free_place, QWidget* parent)
    : QDialog(parent),
      plugins_(std::move(plugins)),
      editor_(editor),
      free_place_(std::move(free_place)),
      model_(named("add_robot_model", new QComboBox)),
      note_(named("add_robot_note", note())),
      search_(named("add_robot_search", new QPushButton(tr("Look for the meshes in a folder…")))),
      name_(named("add_robot_name", new QLineEdit)),
      on_(named("add_robot_on", new QComboBox)),
      pose_(new PoseForm),
      add_(named("add_robot_now", new QPushButton(tr("Add")))),
      X_(geometric::Pose::Identity()) {
  setObjectName(QStringLiteral("add_robot_dialog"));
  setWindowTitle(tr("Add a robot"));
  setAttribute(Qt::WA_DeleteOnClose);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  add_->setProperty("role", "primary");
  add_->setDefault(true);
  buttons->addButton(add_, QDialogButtonBox::AcceptRole);
  connect(add_, &QPushButton::clicked, this, &AddRobotDialog::add);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(&job_, &LatestJob::failed, this,
          [this](const QString& message) { show_note(message, true); });
  lay_out(*this, in_column({make_form(), room(1), buttons}, 12), {16, 14, 16, 14});
  resize(within_window(*this, {scaled(kWidth), scaled(400)}));
  list_library();
  list_links();
  follow_selection(editor_.selection());
  connect(&editor_, &SceneEditor::selection_changed, this, &AddRobotDialog::follow_selection);
  connect(&editor_.document(), &Document::opened, this, [this](Document::Opened what) {
    if (what == Document::Opened::kScene) {
      reject();
    } else {
      list_links();
    }
  });
  read_chosen();
}

QWidget* AddRobotDialog::make_form() {
  note_->setTextFormat(Qt::RichText);
  note_->setWordWrap(true);
  note_->setMinimumWidth(scaled(300));  // or a form leaves room for more lines
  note_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  on_->setToolTip(tr("Click a link in the view or the tree to choose it here"));
  auto* browse_button = named("add_robot_browse", new QPushButton(tr("From a file…")));
  browse_button->setAutoDefault(false);
  for (QComboBox* choice : {model_, on_}) {
    choice->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  }
  search_->setAutoDefault(false);
  connect(search_, &QPushButton::clicked, this, &AddRobotDialog::search);
  auto* model_row = in_row({{model_, 1}, browse_button}, 8);
  auto* form = new QWidget;
  auto* rows = new QFormLayout(form);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setHorizontalSpacing(12);
  rows->setVerticalSpacing(8);
  rows->addRow(tr("Robot"), model_row);
  rows->addRow(QString(), note_);
  rows->addRow(QString(), search_);
  rows->addRow(tr("Name"), name_);
  rows->addRow(tr("Mounted on"), on_);
  rows->addRow(tr("Pose"), pose_);
  connect(browse_button, &QPushButton::clicked, this, &AddRobotDialog::browse);
  connect(model_, qOverload<int>(&QComboBox::activated), this, &AddRobotDialog::read_chosen);
  connect(on_, qOverload<int>(&QComboBox::activated), this, &AddRobotDialog::show_place);
  connect(pose_, &PoseForm::pose_edited, this, [this](const geometric::Pose& X) { X_ = X; });
  return form;
}

void AddRobotDialog::list_library() {
  for (const std::string& name : geometric::resource_names(ResourceKind::kRobot)) {
    const std::filesystem::path file =
        geometric::find_resource(ResourceKind::kRobot, name, geometric::resource_dir());
    model_->addItem(icon("robot"), QString::fromStdString(name),
                    QString::fromStdString(file.string()));
  }
}

void AddRobotDialog::list_links() {
  const std::optional<planning::LinkOfRobot> before = chosen_link();
  on_->clear();
  on_->addItem(tr("Nothing: it stands in the world"));
  for (const planning::LinkOfRobot& place : planning::mounting_places(*editor_.state().scene, "")) {
    const QString carrier = QString::fromStdString(place.robot);
    const QString link = QString::fromStdString(place.link);
    on_->addItem(tr("%1 of %2").arg(link, carrier), carrier);
    on_->setItemData(on_->count() - 1, link, kLinkRole);
  }
  if (before) {
    choose_link(*before);
  } else if (const auto end = planning::end_of_arm(*editor_.state().scene)) {
    choose_link(*end);
  }
}

std::optional<planning::LinkOfRobot> AddRobotDialog::chosen_link() const {
  if (on_->currentIndex() <= 0) {
    return std::nullopt;
  }
  return planning::LinkOfRobot{on_->currentData().toString().toStdString(),
                               on_->currentData(kLinkRole).toString().toStdString()};
}

void AddRobotDialog::choose_link(const planning::LinkOfRobot& link) {
  for (int row = 1; row < on_->count(); ++row) {
    if (on_->itemData(row).toString().toStdString() == link.robot &&
        on_->itemData(row, kLinkRole).toString().toStdString() == link.link) {
      on_->setCurrentIndex(row);
    }
  }
  show_place();
}

void AddRobotDialog::follow_selection(const SceneItem& item) {
  if (item.kind == SceneItem::Kind::kLink) {
    choose_link(planning::own_link(*editor_.state().scene, item.robot, item.name));
  }
}

void AddRobotDialog::browse() {
  const QString file = choose_robot_file(this);
  if (!file.isEmpty()) {
    choose_file(file.toStdString());
  }
}

void AddRobotDialog::search() {
  const QString folder = ask_for(this, tr("Choose a folder with the meshes"), QString());
  if (!folder.isEmpty()) {
    remember_package_path(folder);
    read_chosen();
  }
}

void AddRobotDialog::choose_file(const std::filesystem::path& file) {
  with_xacro_arguments(this, file, [this, file](const geometric::XacroArguments& arguments) {
    model_->addItem(icon("robot"), QString::fromStdString(file.filename().string()),
                    QString::fromStdString(file.string()));
    model_->setCurrentIndex(model_->count() - 1);
    arguments_[model_->currentIndex()] = arguments;
    read_chosen();
  });
}

void AddRobotDialog::read_chosen() {
  robot_.reset();
  add_->setEnabled(false);
  search_->hide();
  const std::filesystem::path file = model_->currentData().toString().toStdString();
  if (file.empty()) {
    show_note(tr("Choose a robot file."), false);
    return;
  }
  show_note(tr("Reading %1…").arg(QString::fromStdString(file.filename().string())), false);
  job_.run([this, file, arguments = arguments_[model_->currentIndex()],
            plugins = plugins_](const std::stop_token&) -> LatestJob::Answer {
    try {
      return [this, read = read_robot(file, arguments, *plugins)] { take_robot(read); };
    } catch (const geometric::MissingMeshError& error) {
      return [this, message = QString::fromUtf8(error.what())] {
        show_note(message, true);
        search_->show();
      };
    }
  });
}

void AddRobotDialog::take_robot(RobotInstance robot) {
  const geometric::RobotModel& model = *robot.model;
  name_->setText(QString::fromStdString(planning::unused_name(*editor_.state().scene, robot.name)));
  QString words =
      tr("%1 links, %2 independent joints.").arg(model.link_count()).arg(model.variable_count());
  const auto warnings = static_cast<int>(model.description().warnings.size());
  if (warnings > 0) {
    QString warning = QString::fromStdString(model.description().warnings.front());
    warning[0] = warning[0].toUpper();
    words += QLatin1Char(' ') + warning + (warning.endsWith(QLatin1Char('.')) ? "" : ".");
    words += warnings > 1 ? tr(" And %1 more in the messages.").arg(warnings - 1) : QString();
  }
  show_note(words, false);
  robot_ = std::move(robot);
  add_->setEnabled(true);
  show_place();
}

void AddRobotDialog::show_note(const QString& note, bool is_problem) {
  note_->setText(is_problem ? colored(note, colors_of(current_theme()).bad) : note.toHtmlEscaped());
}

void AddRobotDialog::show_place() {
  X_ = chosen_link() || !robot_ ? geometric::Pose::Identity() : free_place_(*robot_);
  pose_->show_pose(X_);
}

void AddRobotDialog::add() {
  if (!robot_) {
    return;
  }
  RobotInstance robot = *robot_;
  robot.name = planning::unused_name(
      *editor_.state().scene,
      name_->text().trimmed().isEmpty() ? robot.name : name_->text().trimmed().toStdString());
  const std::optional<planning::LinkOfRobot> on = chosen_link();
  robot.X_WB = on ? geometric::Pose::Identity() : X_;
  QStringList warnings;
  for (const std::string& warning : robot.model->description().warnings) {
    warnings << QString::fromStdString(warning);
  }
  add_->setEnabled(false);
  show_note(tr("Adding %1…").arg(QString::fromStdString(robot.name)), false);
  const QString name = QString::fromStdString(robot.name);
  editor_.add_robot(std::move(robot), on, X_, [this, name, warnings](const QString& problem) {
    if (problem.isEmpty()) {
      emit added(name, warnings.join(QLatin1Char('\n')));
      accept();
    } else {
      show_note(problem, true);
      add_->setEnabled(true);
    }
  });
}

}  // namespace handway::gui
