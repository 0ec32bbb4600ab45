#include "features/planning/plan_panel.h"

#include "features/planning/preset_bar.h"
#include "widgets/forms/parameter_form.h"
#include "widgets/panels/result_text.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QStandardItemModel>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

namespace handway::gui {
namespace {

constexpr int kPlannersSeen = 14;  // of a list that may have dozens

QLabel* make_heading(const QString& text) {
  auto* heading = new QLabel(text);
  heading->setProperty("role", "heading");
  return heading;
}

}  // namespace

PlanPanel::PlanPanel(const planning::PlannerRegistry& registry, QWidget* parent)
    : QWidget(parent),
      registry_(registry),
      planners_(new QComboBox),
      description_(new QLabel),
      seed_(new QSpinBox),
      seeds_(new QSpinBox),
      merit_(new QComboBox),
      time_limit_(new QDoubleSpinBox),
      margin_(new QDoubleSpinBox),
      threads_(new QSpinBox),
      presets_(new PresetBar(registry)),
      modified_(new QLabel(tr("modified"))),
      reset_(new QPushButton(tr("Reset"))),
      form_place_(new QVBoxLayout),
      sections_(new QVBoxLayout),
      plan_(new QPushButton(tr("Plan"))),
      cancel_(new QPushButton(tr("Cancel"))),
      optimizing_(new QWidget),
      optimize_(new QPushButton(tr("Keep optimising"))),
      optimize_limit_(new QDoubleSpinBox),
      progress_(new QProgressBar),
      validity_(new QLabel),
      result_(new QLabel),
      all_runs_(new QPushButton(tr("All runs"))) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(make_settings(), 1);
  layout->addWidget(make_actions());

  for (const std::string& name : registry_.names()) {
    const auto planner = registry_.create(name);
    planners_->addItem(QString::fromStdString(name), planner->capabilities().needs_basis);
  }
  connect(planners_, &QComboBox::currentTextChanged, this,
          [this](const QString& name) { use_planner(name.toStdString()); });
  connect(reset_, &QPushButton::clicked, presets_, &PresetBar::restore);
  connect(presets_, &PresetBar::applied, this, [this] { rebuild_form(false); });
  connect(presets_, &PresetBar::changed, this, &PlanPanel::show_modified);
  connect(plan_, &QPushButton::clicked, this, &PlanPanel::plan_requested);
  connect(cancel_, &QPushButton::clicked, this, &PlanPanel::cancel_requested);
  set_usual_planner({});
  set_threads(0);
  if (planners_->count() > 0) {
    use_planner(planners_->currentText().toStdString());
  }
  end_run();
}

QWidget* PlanPanel::make_settings() {
  planners_->setObjectName(QStringLiteral("planners"));
  planners_->setMaxVisibleItems(kPlannersSeen);
  description_->setWordWrap(true);
  description_->setProperty("role", "note");
  seed_->setRange(0, std::numeric_limits<int>::max());
  seed_->setValue(1);
  seed_->setObjectName(QStringLiteral("seed"));
  seed_->setToolTip(tr("The same seed gives the same path, on any number of threads"));
  time_limit_->setObjectName(QStringLiteral("time_limit"));
  time_limit_->setRange(0.0, 86400.0);
  time_limit_->setDecimals(1);
  time_limit_->setValue(300.0);
  time_limit_->setSuffix(tr(" s"));
  time_limit_->setSpecialValueText(tr("none"));
  time_limit_->setToolTip(tr("Give up after this time"));
  margin_->setObjectName(QStringLiteral("margin"));
  margin_->setRange(0.0, 1000.0);
  margin_->setDecimals(1);
  margin_->setSuffix(tr(" mm"));
  margin_->setSpecialValueText(tr("none"));
  margin_->setToolTip(
      tr("Clearance that the robot keeps from all else along the path, where start and goal allow "
         "it"));
  threads_->setRange(1, 1024);
  threads_->setObjectName(QStringLiteral("threads"));
  threads_->setToolTip(tr("More threads plan faster; the path stays the same"));

  reset_->setObjectName(QStringLiteral("reset_parameters"));
  reset_->setToolTip(tr("Give every parameter the value that it has in the preset"));
  modified_->setObjectName(QStringLiteral("modified"));
  modified_->setProperty("role", "note");

  auto* box = new QWidget;
  auto* layout = new QVBoxLayout(box);
  layout->setContentsMargins(12, 10, 12, 8);
  layout->setSpacing(8);
  auto* form = new QFormLayout;
  layout->addLayout(form);
  auto* parameters = new QHBoxLayout;
  parameters->addWidget(make_heading(tr("Parameters")));
  parameters->addWidget(modified_);
  parameters->addStretch(1);
  parameters->addWidget(reset_);
  layout->addLayout(parameters);
  layout->addWidget(presets_);
  layout->addLayout(form_place_);
  layout->addLayout(sections_);
  layout->addStretch();
  form->setHorizontalSpacing(10);
  form->setVerticalSpacing(6);
  form->addRow(make_heading(tr("Planner")));
  form->addRow(planners_);
  form->addRow(description_);
  form->addRow(tr("Seed"), seed_);
  form->addRow(tr("Seeds"), make_seeds());
  form->addRow(tr("Time limit"), time_limit_);
  form->addRow(tr("Margin"), margin_);
  form->addRow(tr("Threads"), threads_);
  auto* area = new QScrollArea;
  area->setWidgetResizable(true);
  area->setFrameShape(QFrame::NoFrame);
  area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  area->setWidget(box);
  return area;
}

QWidget* PlanPanel::make_seeds() {
  constexpr int kMostSeeds = 1000;
  seeds_->setObjectName(QStringLiteral("seeds"));
  seeds_->setRange(1, kMostSeeds);
  seeds_->setToolTip(
      tr("Plan with so many seeds, from the one above on, and show the best path of all"));
  merit_->setObjectName(QStringLiteral("merit"));
  merit_->setToolTip(tr("Which of their paths is shown"));
  merit_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  merit_->setMinimumContentsLength(6);
  for (const PathMerit merit : kPathMerits) {
    merit_->addItem(tr("the %1").arg(superlative(merit)), static_cast<int>(merit));
  }
  connect(seeds_, qOverload<int>(&QSpinBox::valueChanged), this, &PlanPanel::show_whether_several);
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  layout->addWidget(seeds_, 1);
  layout->addWidget(merit_, 2);
  return row;
}

QWidget* PlanPanel::make_actions() {
  plan_->setObjectName(QStringLiteral("plan"));
  plan_->setProperty("role", "primary");
  cancel_->setObjectName(QStringLiteral("cancel"));
  progress_->setObjectName(QStringLiteral("progress"));
  progress_->setRange(0, 1000);
  progress_->setTextVisible(false);
  progress_->setFixedHeight(6);
  result_->setObjectName(QStringLiteral("result"));
  result_->setWordWrap(true);
  result_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  result_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  validity_->setObjectName(QStringLiteral("path_validity"));
  validity_->setWordWrap(true);
  validity_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  validity_->hide();
  all_runs_->setObjectName(QStringLiteral("all_runs"));
  all_runs_->setProperty("role", "link");
  all_runs_->setToolTip(tr("Compare the runs of this scene, and put one back"));
  all_runs_->setVisible(false);
  connect(all_runs_, &QPushButton::clicked, this, &PlanPanel::runs_requested);
  auto* box = new QWidget;
  auto* layout = new QVBoxLayout(box);
  layout->setContentsMargins(12, 8, 12, 12);
  layout->setSpacing(8);
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(8);
  buttons->addWidget(plan_, 2);
  buttons->addWidget(cancel_, 1);
  layout->addLayout(buttons);
  layout->addWidget(make_optimizing());
  layout->addWidget(progress_);
  layout->addWidget(validity_);
  layout->addWidget(result_);
  layout->addWidget(all_runs_, 0, Qt::AlignLeft);
  return box;
}

QWidget* PlanPanel::make_optimizing() {
  constexpr double kUsual = 10.0;
  optimize_->setObjectName(QStringLiteral("optimize"));
  optimize_->setToolTip(
      tr("Make the path better for the objective above, until nothing more is to be gained, it is "
         "stopped, or the time is over. The path before stays among the runs."));
  optimize_limit_->setObjectName(QStringLiteral("optimize_limit"));
  optimize_limit_->setRange(0.0, 86400.0);
  optimize_limit_->setDecimals(1);
  optimize_limit_->setValue(kUsual);
  optimize_limit_->setPrefix(tr("for "));
  optimize_limit_->setSuffix(tr(" s"));
  optimize_limit_->setSpecialValueText(tr("until stopped"));
  optimize_limit_->setToolTip(tr("For how long at most; 0: until it is stopped"));
  connect(optimize_, &QPushButton::clicked, this, &PlanPanel::optimize_requested);
  auto* layout = new QHBoxLayout(optimizing_);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  layout->addWidget(optimize_, 2);
  layout->addWidget(optimize_limit_, 1);
  optimizing_->hide();
  return optimizing_;
}

void PlanPanel::set_optimizable(bool optimizable) { optimizing_->setVisible(optimizable); }

double PlanPanel::optimize_limit() const {
  return optimize_limit_->value() > 0.0 ? optimize_limit_->value()
                                        : std::numeric_limits<double>::infinity();
}

void PlanPanel::use_planner(const std::string& name) {
  planner_ = registry_.create(name);
  const QSignalBlocker quiet(planners_);
  planners_->setCurrentText(QString::fromStdString(planner_->name()));
  rebuild_form(true);
}

void PlanPanel::show_planners_that_serve(bool has_basis) {
  auto* items = qobject_cast<QStandardItemModel*>(planners_->model());
  for (int i = 0; i < planners_->count(); ++i) {
    const bool serves = has_basis || !planners_->itemData(i).toBool();
    items->item(i)->setEnabled(serves);
    items->item(i)->setToolTip(serves ? QString()
                                      : tr("Needs a hand basis, and the scene names none"));
  }
}

void PlanPanel::rebuild_form(bool anew) {
  description_->setText(QString::fromStdString(planner_->description()));
  show_whether_several();
  delete form_;
  std::vector<planning::Parameter> parameters = planner_->parameters();
  std::ranges::stable_partition(parameters, [](const planning::Parameter& parameter) {
    return parameter.key == "objective" || parameter.key.starts_with("weight_");
  });
  form_ = new ParameterForm(parameters);
  form_place_->addWidget(form_);
  connect(form_, &ParameterForm::edited, this, [this] {
    presets_->look_again();
    emit settings_changed();
  });
  presets_->show_planner(*planner_, anew);
  emit settings_changed();
}

void PlanPanel::apply(const geometric::PlannerChoice& choice) {
  if (planners_->count() == 0) {
    return;
  }
  use_planner(choice.name.empty() ? usual_planner_ : choice.name);
  for (const auto& [key, value] : choice.settings) {
    set_from_text(find_parameter(planner_->parameters(), key), value);
  }
  rebuild_form(true);
}

void PlanPanel::choose_planner(const std::string& name) {
  if (!planner_ || planner_->name() != planning::PlannerRegistry::current_name(name)) {
    use_planner(name);
  }
}

void PlanPanel::set_parameter(const std::string& key, const std::string& value) {
  if (planner_) {
    set_from_text(find_parameter(planner_->parameters(), key), value);
    rebuild_form(false);
  }
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

void PlanPanel::add_section(QWidget* section) { sections_->addWidget(section); }

void PlanPanel::set_seed(std::uint64_t seed) { seed_->setValue(static_cast<int>(seed)); }

void PlanPanel::restore(const planning::PlanRequest& request) {
  set_seed(request.seed);
  set_seeds(1);
  time_limit_->setValue(std::isfinite(request.time_limit_s) ? request.time_limit_s : 0.0);
  margin_->setValue(request.margin_mm);
}

void PlanPanel::set_seeds(int seeds) { seeds_->setValue(seeds); }

int PlanPanel::seeds() const { return seeds_->value(); }

PathMerit PlanPanel::merit() const { return static_cast<PathMerit>(merit_->currentData().toInt()); }

void PlanPanel::show_whether_several() {
  const bool several = seeds() > 1;
  merit_->setEnabled(several);
  threads_->setEnabled(several || (planner_ && planner_->capabilities().uses_threads));
}

std::vector<std::shared_ptr<planning::Planner>> PlanPanel::copies(int count) const {
  std::vector<std::shared_ptr<planning::Planner>> copies;
  for (int i = 0; i < count; ++i) {
    std::shared_ptr<planning::Planner> copy = registry_.create(planner_->name());
    const std::vector<planning::Parameter> parameters = copy->parameters();
    for (const planning::Parameter& parameter : planner_->parameters()) {
      set_from_text(find_parameter(parameters, parameter.key), planning::to_text(parameter));
    }
    copies.push_back(std::move(copy));
  }
  return copies;
}

void PlanPanel::set_usual_planner(const std::string& name) {
  const std::vector<std::string> names = registry_.names();
  const std::string current(planning::PlannerRegistry::current_name(name));
  const bool known = std::ranges::find(names, current) != names.end();
  usual_planner_ = known ? current : names.empty() ? std::string() : names.front();
}

void PlanPanel::set_threads(int threads) {
  const unsigned processors = std::max(1U, std::thread::hardware_concurrency());
  threads_->setValue(threads > 0 ? threads : static_cast<int>(processors));
}

void PlanPanel::set_time_limit(double seconds) { time_limit_->setValue(seconds); }

planning::PlanRequest PlanPanel::request() const {
  planning::PlanRequest request;
  request.seed = static_cast<std::uint64_t>(seed_->value());
  request.threads = threads_->value();
  if (time_limit_->value() > 0.0) {
    request.time_limit_s = time_limit_->value();
  }
  request.margin_mm = margin_->value();
  return request;
}

geometric::PlannerChoice PlanPanel::choice() const {
  geometric::PlannerChoice choice;
  if (!planner_) {
    return choice;
  }
  choice.name = planner_->name();
  const std::unique_ptr<planning::Planner> fresh = registry_.create(choice.name);
  const std::vector<planning::Parameter> usual = fresh->parameters();
  for (const planning::Parameter& parameter : planner_->parameters()) {
    std::string value = planning::to_text(parameter);
    if (value != planning::to_text(planning::find_parameter(usual, parameter.key))) {
      choice.settings.emplace_back(parameter.key, std::move(value));
    }
  }
  return choice;
}

void PlanPanel::set_ready(bool ready, const QString& why_not) {
  ready_ = ready && planner_ != nullptr;
  plan_->setToolTip(ready ? tr("Find a path from start to goal (Ctrl+P)") : why_not);
  end_run();
}

void PlanPanel::show_running() {
  begin_run();
  result_->setText(tr("Planning…"));
}

void PlanPanel::show_optimizing() {
  begin_run();
  cancel_->setText(tr("Stop"));
  cancel_->setToolTip(tr("Keep the best path so far"));
  result_->setText(tr("Optimising…"));
}

void PlanPanel::show_optimizing(const OptimizeProgress& progress) {
  const double done = std::isfinite(progress.limit_s) ? progress.seconds / progress.limit_s : 0.0;
  progress_->setRange(0, std::isfinite(progress.limit_s) ? 1000 : 0);  // 0: busy
  progress_->setValue(static_cast<int>(std::lround(1000.0 * std::min(1.0, done))));
  result_->setText(optimizing_text(progress));
}

void PlanPanel::begin_run() {
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
  modified_->setVisible(modified);
  reset_->setEnabled(modified && form_ && form_->isEnabled());
  if (form_) {
    form_->mark(presets_->modified_keys());
  }
}

void PlanPanel::show_progress(double fraction, const QString& activity) {
  progress_->setValue(static_cast<int>(std::lround(1000.0 * fraction)));
  if (!activity.isEmpty()) {
    result_->setText(tr("Planning: %1…").arg(activity));
  }
}

void PlanPanel::show_seeds(int done, int solved) {
  progress_->setValue(1000 * done / seeds());
  result_->setText(
      tr("Planning: %1 of %2 seeds done, %3 with a path…").arg(done).arg(seeds()).arg(solved));
}

void PlanPanel::show_result(const planning::PlanResult& result, const QString& note) {
  end_run();
  result_->setText(result_text(result, note));
  all_runs_->setVisible(true);
}

void PlanPanel::show_replanned(const planning::PlanResult& result, const QString& way) {
  result_->setText(replanned_text(result, way));
}

void PlanPanel::show_validity(const QString& reason) {
  validity_->setText(QStringLiteral("<span style=\"color:%1\">%2</span>")
                         .arg(html(colors_of(current_theme()).bad), reason.toHtmlEscaped()));
  validity_->setVisible(!reason.isEmpty());
}

void PlanPanel::show_failure(const QString& message) {
  end_run();
  result_->setText(failure_text(message));
}

void PlanPanel::clear_result() { result_->clear(); }

}  // namespace handway::gui
