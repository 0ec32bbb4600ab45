#include "features/export/export_dialog.h"

#include "features/export/motion_preview.h"
#include "features/export/pictures_dialog.h"
#include "features/workbench.h"
#include "model/document/document.h"
#include "view3d/scene_view.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/parameter_form.h"
#include "widgets/panels/log_panel.h"
#include "widgets/style/actions.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

#include <QCheckBox>
#include <QDesktopServices>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QStringList>
#include <QUrl>
#include <QVariant>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::gui {
namespace {

constexpr int kSettleMs = 250;
constexpr int kSettingsWidth = 300;
/// The settings that the dialog shows; those of the required clearance are preferences.
std::vector<geometric::BoundParameter> shown_parameters(planning::TimingSettings& settings) {
  std::vector<geometric::BoundParameter> list = parameters_of(settings);
  std::erase_if(list, [](const geometric::BoundParameter& parameter) {
    return parameter.key == "margin" || parameter.key == "following_error";
  });
  return list;
}

void note_exported(Workbench& workbench, const QString& files) {
  workbench.log.add(LogPanel::Level::kNote, QObject::tr("Exported %1").arg(files));
}

void open(ExportDialog* dialog, Workbench& workbench) {
  dialog->set_margin(workbench.plan_settings.request().margin);
  QObject::connect(dialog, &ExportDialog::exported, &workbench, [&](const QStringList& files) {
    note_exported(workbench, files.join(QStringLiteral(", ")));
  });
  dialog->open();
}

void export_path(Workbench& workbench) {
  open(new ExportDialog(workbench.plugins, workbench.document, workbench.player.timeline().path(),
                        workbench.scene_name(), &workbench.window),
       workbench);
}

Film film_of_path(const Workbench& workbench) {
  const auto& scene = workbench.document.scene();
  const PathTimeline timeline = workbench.player.timeline();
  return {QObject::tr("Export pictures of the path"),
          scene->name.empty() ? QObject::tr("path") : QString::fromStdString(scene->name), scene,
          timeline.duration(),
          [timeline](double fraction) { return FilmMoment{timeline.at(fraction)}; }};
}

void export_pictures(Workbench& workbench, Film film) {
  auto* dialog = new PicturesDialog(std::move(film), workbench.view.camera(), &workbench.window);
  QObject::connect(dialog, &PicturesDialog::exported, &workbench,
                   [&](const QString& file) { note_exported(workbench, file); });
  dialog->open();
}

}  // namespace

ExportRunner::ExportRunner(std::shared_ptr<const planning::PluginManager> plugins, QObject* parent)
    : QObject(parent), plugins_(std::move(plugins)) {
  connect(&job_, &LatestJob::failed, this, &ExportRunner::failed);
}

void ExportRunner::prepare(const std::string& format,
                           std::shared_ptr<const planning::TimedPath> motion,
                           const planning::ExportOptions& options) {
  job_.run([this, &exporter = plugins_->exporter(format), motion = std::move(motion),
            options](const std::stop_token&) {
    const auto files = std::make_shared<const Files>(exporter.files(motion->motion, options));
    return [this, files] { emit prepared(files); };
  });
}

void ExportRunner::write(const std::string& format,
                         std::shared_ptr<const planning::TimedPath> motion,
                         std::filesystem::path folder, const planning::ExportOptions& options) {
  job_.run([this, &exporter = plugins_->exporter(format), motion = std::move(motion),
            folder = std::move(folder), options](const std::stop_token&) {
    QStringList files;
    for (const std::filesystem::path& file : exporter.write(motion->motion, folder, options)) {
      files << QString::fromStdString(file.string());
    }
    return [this, files] { emit written(files); };
  });
}

ExportDialog::ExportDialog(std::shared_ptr<const planning::PluginManager> plugins,
                           Document& document, planning::Path path, const QString& name,
                           QWidget* parent)
    : ExportDialog(std::move(plugins), document, std::move(path), std::nullopt,
                   tr("Export the path"), name, parent) {}

ExportDialog::ExportDialog(std::shared_ptr<const planning::PluginManager> plugins,
                           Document& document, const DerivedSource& source, QWidget* parent)
    : ExportDialog(std::move(plugins), document, {}, source, source.value.title, source.value.name,
                   parent) {}

ExportDialog::ExportDialog(std::shared_ptr<const planning::PluginManager> plugins,
                           Document& document, planning::Path path,
                           std::optional<DerivedSource> source, const QString& title,
                           const QString& name, QWidget* parent)
    : QDialog(parent),
      plugins_(plugins),
      document_(document),
      path_(std::move(path)),
      source_(std::move(source)),
      export_(std::move(plugins)),
      formats_(named("export_formats", new QListWidget)),
      name_(named("export_name", new QLineEdit(QString::fromStdString(
                                     planning::motion_name(name.toStdString()))))),
      timing_form_(
          new ParameterForm(geometric::values_of(shown_parameters(timing_settings_)), this)),
      any_robot_(named("export_any_robot", new QCheckBox(tr("Any robot")))),
      too_close_(named("export_too_close", new QCheckBox(tr("Accept low clearance")))),
      preview_(new MotionPreview),
      folder_(named("export_folder", new QLineEdit(QDir::homePath()))),
      export_button_(named("export_now", new QPushButton(tr("Export")))),
      problem_text_(named("export_problem", new QLabel)),
      written_(named("export_written", new QListWidget)),
      open_folder_(named("export_open_folder", new QPushButton(tr("Open folder")))) {
  setWindowTitle(title);
  setAttribute(Qt::WA_DeleteOnClose);
  resize(within_window(*this, {scaled(940), scaled(600)}));
  lay_out(*this,
          in_column({{in_row({make_settings(), {preview_, 1}}, 12), 1}, make_destination()}, 10),
          {14, 12, 14, 14});
  settle_.setSingleShot(true);
  settle_.setInterval(kSettleMs);
  connect(&settle_, &QTimer::timeout, this, &ExportDialog::time_again);
  connect(&timing_, &TimingRunner::timed, this, [this](const DerivedMotion& motion) {
    motion_ = motion;
    any_robot_->setVisible(
        !plugins_->exporter(format()).robot_objection(motion.value->motion).empty());
    too_close_->setVisible(motion.value->preflight.is_tight());
    preview_->show_motion(*motion.value,
                          plugins_->exporter(format()).warnings(motion.value->motion));
    if (motion.value->cleared()) {
      export_.prepare(format(), motion.value, options());
    }
  });
  connect(&timing_, &TimingRunner::failed, this, &ExportDialog::show_problem);
  connect(&export_, &ExportRunner::prepared, this, [this](const auto& files) {
    preview_->show_files(*files);
    has_files_ = true;
    update_button();
  });
  connect(&export_, &ExportRunner::written, this, [this](const QStringList& files) {
    show_written(files);
    emit exported(files);
  });
  connect(&export_, &ExportRunner::failed, this, &ExportDialog::show_problem);
  connect(&document_, &Document::edited, this, &ExportDialog::take_edit);
  connect(&document_, &Document::opened, this, &QDialog::reject);
  formats_->setCurrentRow(0);
  settle_.stop();
  time_again();
}

void ExportDialog::take_edit(const planning::SceneState& before) {
  if (before.scene == document_.scene()) {
    return;
  }
  if (source_) {
    reject();
  } else {
    time_again();
  }
}

QWidget* ExportDialog::make_settings() {
  formats_->setAccessibleName(tr("Formats"));
  formats_->setProperty("role", "choices");
  formats_->setWordWrap(true);
  formats_->setSpacing(2);
  for (const auto& exporter : plugins_->exporters()) {
    const QString name = QString::fromStdString(exporter->name());
    auto* item = new QListWidgetItem(
        name + QLatin1Char('\n') + QString::fromStdString(exporter->description()), formats_);
    item->setData(Qt::UserRole, name);
  }
  name_->setToolTip(tr("Name of the motion, used in the files and for their names"));
  auto* form = new QFormLayout;
  form->setHorizontalSpacing(10);
  form->setVerticalSpacing(6);
  form->addRow(tr("Name"), name_);
  form->addRow(timing_form_);
  any_robot_->setToolTip(tr("Export even if the format does not seem to suit this robot"));
  any_robot_->hide();
  form->addRow(QString(), any_robot_);
  too_close_->setToolTip(
      tr("Export although the clearance is less than following error and margin require: see "
         "Pre-flight. Applies to one motion"));
  too_close_->hide();
  form->addRow(QString(), too_close_);
  auto* box = new QWidget;
  box->setFixedWidth(scaled(kSettingsWidth));
  lay_out(*box, in_column({{formats_, 1}, form}, 10));
  const auto settle = [this] {
    export_button_->setEnabled(false);
    settle_.start();
  };
  connect(formats_, &QListWidget::currentRowChanged, this, settle);
  connect(name_, &QLineEdit::textEdited, this, settle);
  connect(any_robot_, &QCheckBox::toggled, this, settle);
  connect(too_close_, &QCheckBox::toggled, this, &ExportDialog::update_button);
  connect(timing_form_, &ParameterForm::edited, this,
          [this, settle](const std::string& key, const std::string& value) {
            set_from_text(find_parameter(shown_parameters(timing_settings_), key), value);
            settle();
          });
  return box;
}

QWidget* ExportDialog::make_destination() {
  problem_text_->setWordWrap(true);
  problem_text_->setTextFormat(Qt::RichText);
  problem_text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  problem_text_->hide();
  folder_->setAccessibleName(tr("Folder"));
  auto* browse = new QPushButton(tr("Browse…"));
  auto* close = named("export_close", new QPushButton(tr("Close")));
  export_button_->setProperty("role", "primary");
  export_button_->setDefault(true);
  export_button_->setEnabled(false);
  auto* row = new QHBoxLayout;
  row->setSpacing(8);
  row->addWidget(new QLabel(tr("To folder")));
  row->addWidget(folder_, 1);
  row->addWidget(browse);
  row->addSpacing(18);
  row->addWidget(close);
  row->addWidget(export_button_);
  connect(browse, &QPushButton::clicked, this, [this] {
    const QString folder =
        QFileDialog::getExistingDirectory(this, tr("Export to folder"), folder_->text());
    if (!folder.isEmpty()) {
      folder_->setText(folder);
    }
  });
  connect(close, &QPushButton::clicked, this, &QDialog::reject);
  connect(open_folder_, &QPushButton::clicked, this, [this] {
    const QListWidgetItem* item = written_->currentItem();
    QDesktopServices::openUrl(QUrl::fromLocalFile(item->data(Qt::UserRole).toString()));
  });
  connect(export_button_, &QPushButton::clicked, this, &ExportDialog::export_now);
  written_->setAccessibleName(tr("Written files"));
  written_->hide();
  open_folder_->setToolTip(tr("Show the folder of the chosen files"));
  open_folder_->hide();
  return boxed(in_column(
      {problem_text_, in_row({{written_, 1}, {open_folder_, 0, Qt::AlignTop}}, 8), row}, 8));
}

// Each export is a row: the format, the number of files, and their folder.
void ExportDialog::show_written(const QStringList& files) {
  constexpr int kRows = 3;
  const QString folder = QFileInfo(files.front()).absolutePath();
  const QString count = files.size() == 1 ? tr("1 file") : tr("%1 files").arg(files.size());
  auto* item = new QListWidgetItem(
      tr("%1: %2 in %3")
          .arg(QString::fromStdString(format()), count, QDir::toNativeSeparators(folder)));
  item->setToolTip(files.join(QLatin1Char('\n')));
  item->setData(Qt::UserRole, folder);
  written_->insertItem(0, item);
  written_->setCurrentRow(0);
  written_->setFixedHeight(kRows * written_->sizeHintForRow(0) + 2 * written_->frameWidth());
  written_->show();
  open_folder_->show();
  problem_text_->hide();
  setEnabled(true);
  update_button();
}

void ExportDialog::choose_format(const std::string& name) {
  for (int row = 0; row < formats_->count(); ++row) {
    if (formats_->item(row)->data(Qt::UserRole).toString().toStdString() == name) {
      formats_->setCurrentRow(row);
    }
  }
}

void ExportDialog::set_folder(const QString& folder) { folder_->setText(folder); }

void ExportDialog::set_margin(double margin) {
  if (std::exchange(safety_.margin, margin) != margin) {
    time_again();
  }
}

std::string ExportDialog::format() const {
  return formats_->currentItem()->data(Qt::UserRole).toString().toStdString();
}

void ExportDialog::time_again() {
  motion_ = {};
  has_files_ = false;
  too_close_->setChecked(false);
  too_close_->hide();
  export_.forget();
  export_button_->setEnabled(false);
  problem_text_->hide();
  if (!formats_->currentItem()) {
    preview_->show_waiting(tr("No exporter is installed."));
    return;
  }
  const planning::Exporter& exporter = plugins_->exporter(format());
  const bool stops = exporter.stops_at_waypoints();
  timing_form_->set_enabled("blend", !stops);
  timing_form_->set_enabled("period_ms", exporter.point_period() == 0.0);
  for (const char* key : {"deviation", "arc_clearance_mm"}) {
    timing_form_->set_enabled(key, !stops && timing_settings_.blend);
  }
  preview_->show_waiting(tr("Timing the path…"));
  planning::TimingOptions options =
      timing_options(exporter.settings_for(timing_settings_), *document_.robot()->model);
  options.safety = safety_;
  const std::string name = planning::motion_name(name_->text().toStdString());
  if (source_) {
    timing_.start(*source_, name, options);
  } else {
    timing_.start(document_.problem(), path_, name, options);
  }
}

bool ExportDialog::is_allowed() const {
  return motion_.value && motion_.value->cleared() &&
         (!motion_.value->preflight.is_tight() || too_close_->isChecked());
}

void ExportDialog::update_button() {
  export_button_->setEnabled(has_files_ && !settle_.isActive() && is_allowed());
}

void ExportDialog::export_now() {
  if (!is_allowed()) {
    return;
  }
  if (motion_.made_from != document_.revision()) {
    time_again();
    show_problem(tr("The path is out of date: the scene was edited."));
    return;
  }
  setEnabled(false);  // what is written now is what was seen
  export_.write(format(), motion_.value, folder_->text().toStdString(), options());
}

planning::ExportOptions ExportDialog::options() const { return {any_robot_->isChecked()}; }

void ExportDialog::show_problem(const QString& message) {
  problem_text_->setText(colored(message, colors_of(current_theme()).bad));
  problem_text_->show();
  setEnabled(true);
  export_button_->setEnabled(is_allowed());
}

void add_export(Workbench& workbench) {
  QAction* pictures = workbench.make_action({}, QObject::tr("Export p&ictures of the path…"), {},
                                            QObject::tr("Film strip, frames, film or animation "
                                                        "of the path"));
  pictures->setObjectName(QStringLiteral("pictures"));
  QAction* path = workbench.make_action({}, QObject::tr("&Export the path…"),
                                        QKeySequence(QStringLiteral("Ctrl+E")),
                                        QObject::tr("Time the path and write it for a controller"));
  path->setObjectName(QStringLiteral("export_path"));
  const QString no_path = QObject::tr("Plan a path first (Ctrl+P), or open one.");
  allow(*pictures, no_path);
  allow(*path, no_path);
  workbench.add_to_menu(MainMenu::kFile, {1, 10}, pictures);
  workbench.add_to_menu(MainMenu::kFile, {1, 11}, path);
  QObject::connect(&workbench.player, &PathPlayer::timeline_changed, pictures,
                   [&, pictures, no_path] {
                     allow(*pictures, workbench.player.timeline().empty() ? no_path : QString());
                   });
  QObject::connect(&workbench.validity, &PathValidity::changed, path, [&, path, no_path] {
    const bool valid = workbench.validity.state() == PathValidity::State::kValid;
    const QString& reason = workbench.validity.reason();
    allow(*path, valid ? QString() : reason.isEmpty() ? no_path : reason);
  });
  QObject::connect(pictures, &QAction::triggered, &workbench,
                   [&] { export_pictures(workbench, film_of_path(workbench)); });
  QObject::connect(&workbench, &Workbench::pictures_wanted, &workbench,
                   [&](const Film& film) { export_pictures(workbench, film); });
  QObject::connect(path, &QAction::triggered, &workbench, [&] { export_path(workbench); });
  QObject::connect(
      &workbench, &Workbench::export_wanted, &workbench, [&](const DerivedSource& source) {
        open(new ExportDialog(workbench.plugins, workbench.document, source, &workbench.window),
             workbench);
      });
}

}  // namespace handway::gui
