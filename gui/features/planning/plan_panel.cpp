#include "features/planning/plan_panel.h"

#include "features/planning/preset_bar.h"
#include "handway/geometric/io/parameter.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/core/request_parameters.h"
#include "model/planning/planning_session.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/disclosure.h"
#include "widgets/forms/parameter_form.h"
#include "widgets/forms/typed_input.h"
#include "widgets/panels/dock_layout.h"
#include "widgets/panels/result_text.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QStandardItemModel>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace handway::gui {
namespace {

using geometric::Parameter;

constexpr int kPlannersSeen = 14;  // of a list that may have dozens
constexpr int kClockMs = 100;

QFormLayout* make_form() {
  auto* form = new QFormLayout;
  form->setHorizontalSpacing(10);
  form->setVerticalSpacing(6);
  return form;
}

// The label of a setting of the request.
QString label_of(const char* key) {
  return QString::fromStdString(find_parameter(planning::request_parameters(), key).label);
}

}  // namespace

PlanPanel::PlanPanel(PlanSettings& settings, QWidget* parent)
    : QWidget(parent),
      settings_(settings),
      planners_(named("planners", new QComboBox)),
      description_(note()),
      seed_(named("seed", new QSpinBox)),
      seeds_(named("seeds", new QSpinBox)),
      merit_(named("merit", new QComboBox)),
      time_limit_(named("time_limit", new QDoubleSpinBox)),
      margin_(named("margin", new QDoubleSpinBox)),
      threads_(named("threads", new QSpinBox)),
      presets_(new PresetBar(settings.registry())),
      modified_(named("modified", note(tr("modified")))),
      reset_(named("reset_parameters", new QPushButton(tr("Reset")))),
      changes_(boxed(in_row({modified_, room(1), reset_}))),
      form_place_(new QVBoxLayout),
      sections_(new QVBoxLayout),
      usual_(make_form()),
      plan_(named("plan", new QPushButton(tr("Plan")))),
      cancel_(named("cancel", new QPushButton(tr("Cancel")))),
      optimizing_(new QWidget),
      optimize_(named("optimize", new QPushButton(tr("Continue optimising")))),
      optimize_limit_(named("optimize_limit", new QDoubleSpinBox)),
      progress_(named("progress", new QProgressBar)),
      missing_(named("missing", note())),
      validity_(named("path_validity", new QLabel)),
      result_(named("result", new QLabel)),
      all_runs_(named("all_runs", new QPushButton(tr("All runs")))) {
  lay_out(*this, in_column({make_actions(), make_results(), {make_settings(), 1}}, 0));

  const planning::PlannerRegistry& registry = settings_.registry();
  for (const std::string& name : registry.names()) {
    const auto planner = registry.create(name);
    planners_->addItem(QString::fromStdString(name), planner->capabilities().needs_basis);
  }
  show_request();
  connect_settings();
  connect(reset_, &QPushButton::clicked, presets_, &PresetBar::restore);
  connect(presets_, &PresetBar::applied, this, [this] { rebuild_form(false); });
  connect(presets_, &PresetBar::changed, this, [this] {
    settings_.set_preset(presets_->words());
    show_modified();
  });
  clock_.setInterval(kClockMs);
  connect(&clock_, &QTimer::timeout, this, &PlanPanel::show_elapsed);
  connect(plan_, &QPushButton::clicked, this, &PlanPanel::plan_requested);
  connect(cancel_, &QPushButton::clicked, this, &PlanPanel::cancel_requested);
  if (settings_.planner()) {
    rebuild_form(true);
  }
  end_run();
}

void PlanPanel::connect_settings() {
  const auto changed = qOverload<double>(&QDoubleSpinBox::valueChanged);
  const auto counted = qOverload<int>(&QSpinBox::valueChanged);
  connect(planners_, &QComboBox::currentTextChanged, &settings_,
          [this](const QString& name) { settings_.use_planner(name.toStdString()); });
  connect(seed_, counted, &settings_,
          [this](int seed) { settings_.set_seed(static_cast<std::uint64_t>(seed)); });
  connect(seeds_, counted, &settings_, &PlanSettings::set_seeds);
  connect(merit_, qOverload<int>(&QComboBox::currentIndexChanged), &settings_,
          [this] { settings_.set_merit(static_cast<PathMerit>(merit_->currentData().toInt())); });
  connect(time_limit_, changed, &settings_, &PlanSettings::set_time_limit);
  connect(margin_, changed, &settings_,
          [this](double millimetres) { settings_.set_margin(geometric::metres(millimetres)); });
  connect(threads_, counted, &settings_, &PlanSettings::set_threads);
  connect(optimize_limit_, changed, &settings_, &PlanSettings::set_optimize_limit);
  connect(&settings_, &PlanSettings::planner_changed, this, &PlanPanel::rebuild_form);
  connect(&settings_, &PlanSettings::request_changed, this, &PlanPanel::show_request);
}

void PlanPanel::show_request() {
  // Shown, not entered: a field rounds, and the settings shall not.
  const QSignalBlocker quiet(merit_);
  const planning::PlanRequest& request = settings_.request();
  show_value(*seed_, static_cast<int>(request.seed));
  show_value(*seeds_, settings_.seeds());
  merit_->setCurrentIndex(merit_->findData(static_cast<int>(settings_.merit())));
  show_value(*time_limit_, std::isfinite(request.time_limit_s) ? request.time_limit_s : 0.0);
  show_value(*margin_, geometric::millimetres(request.margin));
  show_value(*threads_, request.threads);
  const double limit = settings_.optimize_limit();
  show_value(*optimize_limit_, std::isfinite(limit) ? limit : 0.0);
  show_whether_several();
}

void PlanPanel::follow(PlanningSession& session) {
  connect(this, &PlanPanel::plan_requested, &session, &PlanningSession::start);
  connect(this, &PlanPanel::optimize_requested, &session, &PlanningSession::optimize);
  connect(this, &PlanPanel::cancel_requested, &session, &PlanningSession::cancel);
  connect(&session, &PlanningSession::forgotten, this, [this] {
    shown_.reset();
    result_->clear();
  });
  connect(&session, &PlanningSession::started, this, &PlanPanel::show_running);
  connect(&session, &PlanningSession::progressed, this, &PlanPanel::show_progress);
  connect(&session, &PlanningSession::seeds_done, this, &PlanPanel::show_seeds);
  connect(&session, &PlanningSession::optimizing_started, this, &PlanPanel::show_optimizing);
  connect(&session, &PlanningSession::optimized_further, this, &PlanPanel::show_optimize_progress);
  connect(&session, &PlanningSession::result_found, this, &PlanPanel::show_result);
  connect(&session, &PlanningSession::replanned, this, &PlanPanel::show_replanned);
  connect(&session, &PlanningSession::path_opened, this, [this](const QString& note) {
    shown_.reset();
    result_->setText(note.toHtmlEscaped());
  });
  connect(&session, &PlanningSession::failed, this, &PlanPanel::show_failure);
}

void PlanPanel::follow(const PathHistory& history) {
  connect(&history, &PathHistory::changed, this, [this, &history] {
    for (const PathRecord& record : history.records()) {
      if (shown_ && record.figures && record.is_solved() &&
          same_path(record.run->result.path, shown_->result.path)) {
        result_->setText(result_text(shown_->result, shown_->note, record.figures));
        return;
      }
    }
  });
}

QWidget* PlanPanel::make_settings() {
  planners_->setMaxVisibleItems(kPlannersSeen);
  description_->setWordWrap(true);
  seed_->setRange(0, std::numeric_limits<int>::max());
  seed_->setToolTip(tr("The same seed gives the same path, on any number of threads"));
  for (auto& [field, key] : {std::pair{time_limit_, "time_limit"}, std::pair{margin_, "margin"}}) {
    const Parameter& described = find_parameter(planning::request_parameters(), key);
    field->setRange(0.0, described.upper);
    field->setDecimals(1);
    field->setSuffix(QStringLiteral(" %1").arg(QString::fromStdString(described.unit)));
    field->setSpecialValueText(tr("none"));
    field->setToolTip(QString::fromStdString(described.help));
  }
  const Parameter& threads = find_parameter(planning::request_parameters(), "threads");
  threads_->setRange(static_cast<int>(threads.lower), static_cast<int>(threads.upper));
  threads_->setToolTip(QString::fromStdString(threads.help));

  reset_->setToolTip(tr("Reset every parameter to its value in the preset"));

  usual_->addRow(tr("Planner"), planners_);
  usual_->addRow(description_);
  usual_->addRow(tr("Preset"), presets_);
  usual_->addRow(QString(), changes_);
  usual_->addRow(tr("Seeds"), make_seeds());
  usual_->addRow(label_of("margin"), margin_);
  return new PanelArea(boxed(
      in_column({usual_, new Disclosure("advanced", tr("Advanced"), make_advanced()), room()}, 8),
      {12, 10, 12, 8}));
}

QWidget* PlanPanel::make_advanced() {
  auto* form = make_form();
  form->addRow(tr("Seed"), seed_);
  form->addRow(label_of("time_limit"), time_limit_);
  form->addRow(label_of("threads"), threads_);
  return boxed(in_column({form, heading(tr("Parameters")), form_place_, sections_}, 8));
}

QWidget* PlanPanel::make_seeds() {
  constexpr int kMostSeeds = 1000;
  seeds_->setRange(1, kMostSeeds);
  seeds_->setToolTip(
      tr("Plan with this number of seeds, from the seed above, and show the best path"));
  merit_->setToolTip(tr("Criterion of the best path"));
  merit_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  merit_->setMinimumContentsLength(6);
  for (const PathMerit merit : kPathMerits) {
    merit_->addItem(tr("the %1").arg(superlative(merit)), static_cast<int>(merit));
  }
  return boxed(in_row({{seeds_, 1}, {merit_, 2}}, 8));
}

QWidget* PlanPanel::make_actions() {
  plan_->setProperty("role", "primary");
  progress_->setRange(0, 1000);
  progress_->setTextVisible(false);
  progress_->setFixedHeight(6);
  QSizePolicy keeps_room = progress_->sizePolicy();
  keeps_room.setRetainSizeWhenHidden(true);
  progress_->setSizePolicy(keeps_room);
  return boxed(in_column({in_row({{plan_, 2}, {cancel_, 1}}, 8), make_optimizing(), progress_}, 8),
               {12, 12, 12, 0});
}

QWidget* PlanPanel::make_results() {
  result_->setTextFormat(Qt::RichText);
  result_->setWordWrap(true);
  result_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  result_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  validity_->setTextFormat(Qt::RichText);
  validity_->setWordWrap(true);
  validity_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  validity_->hide();
  all_runs_->setProperty("role", "link");
  all_runs_->setToolTip(tr("Compare the runs of this scene, and restore one"));
  all_runs_->setVisible(false);
  connect(all_runs_, &QPushButton::clicked, this, &PlanPanel::runs_requested);
  missing_->setWordWrap(true);
  return boxed(in_column({missing_, validity_, result_, {all_runs_, 0, Qt::AlignLeft}}, 8),
               {12, 4, 12, 0});
}

QWidget* PlanPanel::make_optimizing() {
  optimize_->setToolTip(
      tr("Optimise the path for the objective above until it converges, is stopped, or the time is "
         "over. The previous path stays among the runs."));
  optimize_limit_->setRange(0.0, find_parameter(planning::request_parameters(), "optimize").upper);
  optimize_limit_->setDecimals(1);
  optimize_limit_->setPrefix(tr("for "));
  optimize_limit_->setSuffix(tr(" s"));
  optimize_limit_->setSpecialValueText(tr("until stopped"));
  optimize_limit_->setToolTip(tr("Time limit of the optimisation; 0: no limit"));
  connect(optimize_, &QPushButton::clicked, this, &PlanPanel::optimize_requested);
  lay_out(*optimizing_, in_row({{optimize_, 2}, {optimize_limit_, 1}}, 8));
  optimizing_->hide();
  return optimizing_;
}

void PlanPanel::set_optimizable(bool optimizable) { optimizing_->setVisible(optimizable); }

void PlanPanel::show_planners_that_serve(bool has_basis) {
  auto* items = qobject_cast<QStandardItemModel*>(planners_->model());
  for (int i = 0; i < planners_->count(); ++i) {
    const bool serves = has_basis || !planners_->itemData(i).toBool();
    items->item(i)->setEnabled(serves);
    items->item(i)->setToolTip(serves ? QString()
                                      : tr("This planner needs a hand basis; the scene has none"));
  }
}

void PlanPanel::rebuild_form(bool from_defaults) {
  planning::Planner& planner = *settings_.planner();
  const QSignalBlocker quiet(planners_);
  planners_->setCurrentText(QString::fromStdString(planner.name()));
  description_->setText(QString::fromStdString(planner.description()));
  show_whether_several();
  delete form_;
  std::vector<geometric::Parameter> parameters = planner.parameters();
  std::erase_if(parameters, [](const geometric::Parameter& parameter) {
    return parameter.key == planning::kPresetKey;  // presets_ offers it
  });
  std::stable_partition(
      parameters.begin(), parameters.end(), [](const geometric::Parameter& parameter) {
        return parameter.key == "objective" || parameter.key.starts_with("weight_");
      });
  form_ = new ParameterForm(parameters, form_place_->parentWidget());
  form_place_->addWidget(form_);
  connect(form_, &ParameterForm::edited, this,
          [this, &planner](const std::string& key, const std::string& value) {
            planner.set_parameter(key, value);
            presets_->look_again();
            settings_.announce_parameters();
          });
  presets_->show_planner(planner, from_defaults);
  settings_.announce_parameters();
}

void PlanPanel::enter(const char* key, double value) {
  if (!form_ || !form_->isEnabled()) {
    return;
  }
  if (auto* field = form_->findChild<QDoubleSpinBox*>(QLatin1String(key))) {
    field->setValue(value);
  } else if (auto* count = form_->findChild<QSpinBox*>(QLatin1String(key))) {
    count->setValue(static_cast<int>(std::lround(value)));
  }
}

void PlanPanel::add_row(const QString& label, QWidget* row) { usual_->addRow(label, row); }

void PlanPanel::add_section(QWidget* section) { sections_->addWidget(section); }

void PlanPanel::show_whether_several() {
  const bool several = settings_.seeds() > 1;
  const auto& planner = settings_.planner();
  merit_->setEnabled(several);
  threads_->setEnabled(several || (planner && planner->capabilities().uses_threads));
}

void PlanPanel::set_ready(bool ready, const QString& why_not) {
  ready_ = ready && settings_.planner() != nullptr;
  plan_->setToolTip(ready ? tr("Find a path from start to goal (Ctrl+P)") : why_not);
  missing_->setText(why_not.simplified());
  missing_->setVisible(!ready);
  end_run();
}

void PlanPanel::show_running() {
  begin_run();
  activity_ = tr("Planning");
  show_elapsed();
}

void PlanPanel::show_elapsed() {
  if (!activity_.isEmpty()) {
    result_->setText(tr("%1, %2 s")
                         .arg(activity_)
                         .arg(1e-3 * static_cast<double>(since_start_.elapsed()), 0, 'f', 1));
  }
}

void PlanPanel::show_optimizing() {
  begin_run();
  cancel_->setText(tr("Stop"));
  cancel_->setToolTip(tr("Keep the best path so far"));
  result_->setText(tr("Optimising…"));
}

void PlanPanel::show_optimize_progress(const OptimizeProgress& progress) {
  const double done = std::isfinite(progress.limit_s) ? progress.seconds / progress.limit_s : 0.0;
  progress_->setRange(0, std::isfinite(progress.limit_s) ? 1000 : 0);  // 0: busy
  progress_->setValue(static_cast<int>(std::lround(1000.0 * std::min(1.0, done))));
  result_->setText(optimizing_text(progress));
}

void PlanPanel::begin_run() {
  shown_.reset();
  since_start_.start();
  clock_.start();
  plan_->setEnabled(false);
  optimize_->setEnabled(false);
  optimize_limit_->setEnabled(false);
  cancel_->setEnabled(true);
  planners_->setEnabled(false);
  seeds_->setEnabled(false);
  merit_->setEnabled(false);
  presets_->setEnabled(false);
  form_->setEnabled(false);
  reset_->setEnabled(false);
  progress_->setRange(0, 1000);
  progress_->setValue(0);
  progress_->setVisible(true);
}

void PlanPanel::end_run() {
  clock_.stop();
  activity_.clear();
  plan_->setEnabled(ready_);
  cancel_->setEnabled(false);
  cancel_->setText(tr("Cancel"));
  cancel_->setToolTip({});
  optimize_->setEnabled(true);
  optimize_limit_->setEnabled(true);
  planners_->setEnabled(true);
  seeds_->setEnabled(true);
  show_whether_several();
  presets_->setEnabled(true);
  if (form_) {
    form_->setEnabled(true);
  }
  show_modified();
  progress_->setVisible(false);
}

void PlanPanel::show_modified() {
  const bool modified = presets_->is_modified();
  changes_->setVisible(modified);
  reset_->setEnabled(modified && form_ && form_->isEnabled());
  if (form_) {
    form_->mark(presets_->modified_keys());
  }
}

void PlanPanel::show_progress(double fraction, const QString& activity) {
  progress_->setValue(static_cast<int>(std::lround(1000.0 * fraction)));
  if (!activity.isEmpty()) {
    activity_ = tr("Planning: %1").arg(activity);
    show_elapsed();
  }
}

void PlanPanel::show_seeds(int done, int solved) {
  const int seeds = settings_.seeds();
  progress_->setValue(1000 * done / seeds);
  activity_ = tr("Planning: %1 of %2 seeds done, %3 with a path").arg(done).arg(seeds).arg(solved);
  show_elapsed();
}

void PlanPanel::show_result(const planning::PlanResult& result, const QString& note) {
  end_run();
  result_->setText(result_text(result, note));
  shown_ = Shown{result, note};
  all_runs_->setVisible(true);
}

void PlanPanel::show_replanned(const planning::PlanResult& result, const QString& origin) {
  shown_.reset();
  result_->setText(replanned_text(result, origin));
}

void PlanPanel::show_validity(const QString& reason) {
  validity_->setText(colored(reason, colors_of(current_theme()).bad));
  validity_->setVisible(!reason.isEmpty());
}

void PlanPanel::show_failure(const QString& message) {
  end_run();
  shown_.reset();
  result_->setText(failure_text(message));
}

}  // namespace handway::gui
