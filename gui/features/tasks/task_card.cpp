#include "features/tasks/task_card.h"

#include "handway/geometric/math/units.h"
#include "handway/planning/grasps/pregrasp_search.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/folding_row.h"
#include "widgets/forms/parameter_form.h"
#include "widgets/panels/film_bar.h"
#include "widgets/style/actions.h"
#include "widgets/style/theme.h"

#include <QCheckBox>
#include <QComboBox>
#include <QEvent>
#include <QHeaderView>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QToolButton>
#include <QTreeWidget>

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace handway::gui {
namespace {

constexpr int kWidth = 340;
constexpr int kMargin = 12;

QString stage_text(planning::StageKind kind) {
  switch (kind) {
    case planning::StageKind::kMove:
      return QObject::tr("Move");
    case planning::StageKind::kApproach:
      return QObject::tr("Approach");
    case planning::StageKind::kReach:
      return QObject::tr("Reach");
    case planning::StageKind::kClose:
      return QObject::tr("Close the hand");
    case planning::StageKind::kLift:
      return QObject::tr("Lift");
    case planning::StageKind::kCarry:
      return QObject::tr("Carry");
    case planning::StageKind::kLower:
      return QObject::tr("Lower");
    case planning::StageKind::kOpen:
      return QObject::tr("Open the hand");
    case planning::StageKind::kRetreat:
      return QObject::tr("Retreat");
    case planning::StageKind::kLine:
      return QObject::tr("Straight line");
    case planning::StageKind::kWait:
      return QObject::tr("Wait");
    case planning::StageKind::kOutput:
      return QObject::tr("Set output");
  }
  return {};
}

}  // namespace

TaskCard::TaskCard(QWidget* host, std::function<std::vector<QPoint>()> to_be_seen)
    : FloatingCard(host, "task", "offer"),
      to_be_seen_(std::move(to_be_seen)),
      title_(heading()),
      support_(named("task_support", new QComboBox)),
      mass_(named("task_mass", new NumberField(0.001, 1000.0))),
      speed_(named("task_speed", new QSpinBox)),
      return_(named("task_return", new QCheckBox(tr("Return to the start")))),
      note_(named("task_note", note())),
      list_(named("task_stages", new QTreeWidget)),
      search_(new QWidget),
      play_(named("task_play", new QPushButton(tr("Play")))),
      simulate_(named("task_simulate", new QPushButton(tr("Simulate")))),
      export_(named("task_export", new QPushButton(tr("Export…")))),
      run_(named("task_run", new QPushButton(tr("Run…")))),
      film_(named("task_film", new FilmBar)),
      keep_(named("task_keep", new QPushButton)),
      plan_(named("task_plan", new QPushButton(tr("Plan")))),
      edit_(named("task_edit", new QPushButton(tr("Edit")))),
      editor_(named("task_editor", new ProgramEditor)),
      choices_(new QWidget) {
  note_->setWordWrap(true);
  support_->setAccessibleName(tr("Place on"));
  support_->setToolTip(tr("Object on whose upward faces the grasped object is placed, anywhere"));
  mass_->setSuffix(tr(" kg"));
  mass_->setValue(planning::PregraspOptions{}.payload);
  mass_->setAccessibleName(tr("Mass"));
  mass_->setToolTip(tr("Mass of the object: the hand squeezes so hard that friction carries it"));
  speed_->setRange(1, 100);
  speed_->setValue(100);
  speed_->setSuffix(tr(" %"));
  speed_->setAccessibleName(tr("Speed"));
  speed_->setToolTip(tr("Share of the full speed that the joint limits allow"));
  return_->setToolTip(tr("Move back to the scene's start at the end"));
  return_->setChecked(true);
  list_->setAccessibleName(tr("Stages"));
  list_->setFrameShape(QFrame::NoFrame);
  list_->setRootIsDecorated(false);
  list_->setUniformRowHeights(true);
  list_->setSelectionMode(QAbstractItemView::SingleSelection);
  list_->header()->setStretchLastSection(false);
  auto* progress = new QProgressBar;
  progress->setRange(0, 0);
  progress->setTextVisible(false);
  progress->setFixedHeight(6);
  auto* stop = named("task_stop", new QPushButton(tr("Stop")));
  stop->setToolTip(tr("End the search"));
  connect(stop, &QPushButton::clicked, this, &TaskCard::stop_wanted);
  lay_out(*search_, in_row({{progress, 1}, stop}, 8));
  play_->setCheckable(true);
  play_->setToolTip(tr("Show the motion of robot and object, stage after stage"));
  connect(play_, &QPushButton::clicked, this, &TaskCard::play_wanted);
  simulate_->setToolTip(tr("Simulate whether the hand holds the object while it is carried"));
  connect(simulate_, &QPushButton::clicked, this, &TaskCard::simulation_wanted);
  export_->setToolTip(tr("Write the whole task as one program for a controller"));
  connect(export_, &QPushButton::clicked, this, &TaskCard::export_wanted);
  run_->setToolTip(tr("Run the whole task on the robot, in the panel Devices"));
  connect(run_, &QPushButton::clicked, this, &TaskCard::run_wanted);
  connect(keep_, &QPushButton::clicked, this, &TaskCard::keep_wanted);
  edit_->setCheckable(true);
  edit_->setToolTip(tr("Show the steps of the program, to change them"));
  connect(edit_, &QPushButton::toggled, this, [this](bool shown) {
    editor_->setVisible(shown);
    appear();
  });
  connect(editor_, &ProgramEditor::edited, this, &TaskCard::steps_edited);
  for (const auto by_person : {&QTreeWidget::itemClicked, &QTreeWidget::itemActivated}) {
    connect(list_, by_person, this,
            [this](QTreeWidgetItem* item) { emit row_chosen(list_->indexOfTopLevelItem(item)); });
  }
  plan_->setProperty("role", "primary");
  plan_->setToolTip(tr("Find a grasp, a place and the motions between them"));
  connect(plan_, &QPushButton::clicked, this, &TaskCard::plan_wanted);
  connect(support_, qOverload<int>(&QComboBox::currentIndexChanged), this, &TaskCard::changed);
  connect(return_, &QCheckBox::toggled, this, &TaskCard::changed);
  connect(mass_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, &TaskCard::changed);
  connect(speed_, qOverload<int>(&QSpinBox::valueChanged), this, &TaskCard::changed);
  QToolButton* close = make_close("task_close", tr("Close; the scene stays as it is"));
  connect(close, &QToolButton::clicked, this, [this] {
    hide();
    emit closed();
  });
  lay_out(*choices_,
          in_column({in_row({new QLabel(tr("Place on")), {support_, 1}}, 8), return_}, 6));
  lay_out(*this,
          in_column({in_row({{title_, 1}, {close, 0, Qt::AlignTop}}),
                     choices_,
                     new FoldingRow({in_row({new QLabel(tr("Mass")), {mass_, 1}}, 8),
                                     in_row({new QLabel(tr("Speed")), {speed_, 1}}, 8)},
                                    8),
                     note_,
                     editor_,
                     search_,
                     {list_, 1},
                     film_,
                     in_row({{play_, 1}, {simulate_, 1}, {export_, 1}, {run_, 1}}, 8),
                     in_row({{plan_, 2}, {edit_, 1}, {keep_, 1}}, 8)},
                    6),
          {12, 6, 8, 10});
}

void TaskCard::ask(const QString& title, const QStringList& supports, bool simulates) {
  program_.clear();
  show_kind(title, false);
  const QSignalBlocker quiet(support_);
  support_->clear();
  support_->addItems(supports);
  simulates_ = simulates;
  ask_again();
}

void TaskCard::ask_program(const geometric::Program& program, const StepNames& names,
                           bool simulates) {
  show_program(program, names);
  simulates_ = simulates;
  ask_again();
}

bool TaskCard::update_supports(const QStringList& supports) {
  const QSignalBlocker quiet(support_);
  const QString chosen = support_->currentText();
  support_->clear();
  support_->addItems(supports);
  support_->setCurrentIndex(std::max(0, support_->findText(chosen)));
  return support_->currentText() == chosen;
}

void TaskCard::show_program(const geometric::Program& program, const StepNames& names) {
  program_ = words_of(program);
  editor_->show_steps(program.steps, names);
  show_kind(title_of(program), true);
}

void TaskCard::edit_steps() { edit_->setChecked(true); }

void TaskCard::show_kind(const QString& title, bool is_program) {
  title_->setText(title);
  choices_->setVisible(!is_program);
  edit_->setVisible(is_program);
  editor_->setVisible(is_program && edit_->isChecked());
  keep_->setText(is_program ? tr("Remove") : tr("Keep"));
  keep_->setToolTip(is_program ? tr("Remove the program from the scene")
                               : tr("Keep the steps as a program of the scene"));
}

void TaskCard::ask_again() {
  set_up(program_.isEmpty() ? tr("The hand grasps the object, carries it, and puts it down.")
                            : tr("Steps: %1").arg(program_),
         State::kAsking);
}

void TaskCard::show_planning(bool again) {
  if (!again) {
    edit_->setChecked(false);
  }
  set_up(
      again ? tr("The scene was edited: planning all stages again…") : tr("Planning all stages…"),
      State::kWorking);
}

void TaskCard::show_simulating() { set_up(tr("Simulating the grasp…"), State::kWorking); }

void TaskCard::show_simulated(const QString& verdict) { set_up(verdict, State::kPlanned); }

void TaskCard::show_plan(const std::vector<ShownStage>& stages, double planned_in) {
  list_->clear();
  list_->setHeaderLabels({tr("Stage"), tr("Time"), tr("Clear")});
  list_->headerItem()->setToolTip(2, tr("Least clearance of the stage, up to 50 mm"));
  double duration = 0.0;
  for (const ShownStage& stage : stages) {
    auto* item = new QTreeWidgetItem(
        list_, {stage_text(stage.kind), tr("%1 s").arg(stage.duration, 0, 'f', 2),
                tr("%1 mm").arg(geometric::millimetres(stage.clearance), 0, 'f', 1)});
    item->setToolTip(2, stage.nearest);
    item->setTextAlignment(1, Qt::AlignRight);
    item->setTextAlignment(2, Qt::AlignRight);
    duration += stage.duration;
  }
  set_up(tr("A motion of %1 s, planned in %2 s. Every stage is free of collisions.")
             .arg(duration, 0, 'f', 1)
             .arg(planned_in, 0, 'f', 1),
         State::kPlanned);
}

void TaskCard::show_failure(const QString& reason,
                            const std::vector<planning::StageTrials>& trials) {
  list_->clear();
  list_->setHeaderLabels({tr("Stage"), tr("Tried"), tr("Failed")});
  for (const planning::StageTrials& one : trials) {
    auto* item = new QTreeWidgetItem(
        list_, {stage_text(one.kind), QString::number(one.tried), QString::number(one.failed)});
    item->setTextAlignment(1, Qt::AlignRight);
    item->setTextAlignment(2, Qt::AlignRight);
    for (int column = 0; column < list_->columnCount(); ++column) {
      item->setToolTip(column, QString::fromStdString(one.reason));
    }
  }
  reason_ = reason;
  set_up(reason, State::kFailed);
}

void TaskCard::show_trial(const planning::StageTrials& trial) {
  set_up(tr("%1: %2 of %3 failed. The first: %4")
             .arg(stage_text(trial.kind))
             .arg(trial.failed)
             .arg(trial.tried)
             .arg(QString::fromStdString(trial.reason)),
         State::kFailed);
}

void TaskCard::show_reason() {
  list_->setCurrentItem(nullptr);
  set_up(reason_, State::kFailed);
}

void TaskCard::show_played(int stage) {
  play_->setChecked(stage >= 0);
  play_->setText(stage >= 0 ? tr("Stop") : tr("Play"));
  list_->setCurrentItem(stage >= 0 ? list_->topLevelItem(stage) : nullptr);
}

QString TaskCard::support() const { return support_->currentText(); }

bool TaskCard::returns() const { return return_->isChecked(); }

double TaskCard::mass() const { return mass_->value(); }

double TaskCard::speed() const { return speed_->value() / 100.0; }

void TaskCard::set_up(const QString& note, State state) {
  note_->setText(note);
  search_->setVisible(state == State::kWorking);
  const bool has_rows = list_->topLevelItemCount() > 0;
  list_->setVisible(state == State::kPlanned || (state == State::kFailed && has_rows));
  play_->setVisible(state == State::kPlanned);
  simulate_->setVisible(state == State::kPlanned && simulates_);
  export_->setVisible(state == State::kPlanned);
  run_->setVisible(state == State::kPlanned);
  film_->setVisible(state == State::kPlanned);
  for (QWidget* asked :
       std::initializer_list<QWidget*>{choices_, mass_, speed_, keep_, edit_, editor_, plan_}) {
    asked->setEnabled(state != State::kWorking);
  }
  appear();
}

void TaskCard::place() {
  const QRect within = parentWidget()->rect().adjusted(kMargin, kMargin, -kMargin, -kMargin);
  const int width = std::min(scaled(kWidth), within.width());
  if (list_->isVisibleTo(this)) {
    list_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    list_->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
    list_->header()->setSectionResizeMode(2, QHeaderView::ResizeToContents);
  }
  list_->setFixedHeight(list_->header()->sizeHint().height() +
                        list_->topLevelItemCount() * list_->sizeHintForRow(0) + 2);
  stand_where_it_hides_least({width, wanted_height(width)}, to_be_seen_());
}

int TaskCard::wanted_height(int width) const {
  return std::min(layout()->totalHeightForWidth(width), parentWidget()->height() - 2 * kMargin);
}

bool TaskCard::event(QEvent* event) {
  const bool taken = FloatingCard::event(event);
  if (event->type() == QEvent::LayoutRequest && editor_->isVisible() &&
      height() != wanted_height(width())) {
    place();
  }
  return taken;
}

}  // namespace handway::gui
