#include "features/runs/runs_panel.h"

#include "features/workbench.h"
#include "handway/geometric/math/units.h"
#include "model/document/scene_editor.h"
#include "model/planning/planning_session.h"
#include "widgets/forms/arrangement.h"
#include "widgets/panels/dock_layout.h"
#include "widgets/panels/result_text.h"
#include "widgets/panels/run_table.h"
#include "widgets/panels/run_view.h"

#include <QItemSelectionModel>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSortFilterProxyModel>

#include <algorithm>

namespace handway::gui {
namespace {

QString settings_text(const PlanRun& run) {
  QStringList texts;
  for (const auto& [key, value] : run.planner.settings) {
    texts << QString::fromStdString(key + " = " + value);
  }
  return texts.isEmpty() ? QObject::tr("the planner's own values")
                         : texts.join(QStringLiteral(", "));
}

RunRow as_row(const PathRecord& record, bool stands_out) {
  const PlanRun& run = *record.run;
  RunRow row;
  row.number = run.number;
  row.planner = QString::fromStdString(run.planner.name);
  row.preset = run.preset;
  row.seed = run.request.seed;
  row.time_s = run.result.time_s;
  row.outcome = status_text(run.result.status);
  row.samples = run.result.statistics.samples;
  if (run.result.solved()) {
    row.nodes = run.result.path.waypoints.size();
    row.clearance = geometric::millimetres(run.result.certificate.min_clearance);
    row.length = length_of(*record.scene->robots.front().model, run.result.path);
  }
  if (record.figures) {
    row.duration = record.figures->duration;
    const auto& hand =
        record.figures->to_recorded ? record.figures->to_recorded : record.figures->to_subspace;
    row.hand_distance = hand ? std::optional(hand->mean) : std::nullopt;
  }
  row.tip = QObject::tr("Run %1 (%2): %3\n%4")
                .arg(run.number)
                .arg(run.begun.toString(QStringLiteral("HH:mm:ss")), settings_text(run),
                     result_tip(run.result));
  row.stands_out = stands_out;
  return row;
}

}  // namespace

RunsPanel::RunsPanel(PathHistory& history, QWidget* parent)
    : QWidget(parent),
      history_(history),
      table_(new RunTable(this)),
      sorted_(new QSortFilterProxyModel(this)),
      view_(nullptr),
      state_(named("runs_state", note())),
      restore_(named("runs_restore", new QPushButton(tr("Restore")))),
      compare_(named("runs_compare", new QPushButton(tr("Compare…")))) {
  sorted_->setSourceModel(table_);
  view_ = new RunView(*sorted_,
                      {RunTable::kNumber, RunTable::kPlanner, RunTable::kPreset, RunTable::kSeed,
                       RunTable::kTime, RunTable::kOutcome, RunTable::kLength, RunTable::kDuration,
                       RunTable::kClearance, RunTable::kHandDistance});
  view_->setObjectName(QStringLiteral("runs_table"));
  view_->setAccessibleName(tr("Runs"));
  view_->sortByColumn(RunTable::kNumber, Qt::DescendingOrder);
  lay_out(*this, in_column({make_actions(), {view_, 1}}, 8), {12, 8, 12, 8});
  connect(&history_, &PathHistory::changed, this, &RunsPanel::refresh);
  connect(view_->selectionModel(), &QItemSelectionModel::selectionChanged, this,
          &RunsPanel::show_actions);
  connect(view_, &QTableView::doubleClicked, this, &RunsPanel::restore);
  refresh();
}

QWidget* RunsPanel::make_actions() {
  state_->setWordWrap(true);
  restore_->setToolTip(
      tr("Put back the run's planner, parameters, seed, scene, start and goal, and "
         "show its path. Undo takes the scene back."));
  compare_->setToolTip(tr("Compare two paths side by side"));
  connect(restore_, &QPushButton::clicked, this, &RunsPanel::restore);
  connect(compare_, &QPushButton::clicked, this, &RunsPanel::compare_requested);
  return boxed(in_row({{state_, 1}, restore_, compare_}, 8));
}

void RunsPanel::mark(const std::shared_ptr<const PlanRun>& run) {
  if (marked_ != run) {
    marked_ = run;
    refresh();
  }
}

void RunsPanel::set_running(bool running) {
  running_ = running;
  show_actions();
}

void RunsPanel::refresh() {
  const PathRecord* before = chosen();
  const std::shared_ptr<const PlanRun> kept = before ? before->run : nullptr;
  records_.clear();
  std::vector<RunRow> rows;
  for (const PathRecord& record : history_.records()) {
    if (record.run && history_.is_of_open_scene(record)) {
      records_.push_back(record);
      rows.push_back(as_row(record, record.run == marked_));
    }
  }
  table_->set_rows(std::move(rows));
  if (const QModelIndex row = row_of(kept); row.isValid()) {
    view_->selectRow(row.row());
  }
  if (const QModelIndex row = row_of(marked_); row.isValid()) {
    view_->scrollTo(row);
  }
  const auto solved = std::ranges::count_if(records_, &PathRecord::is_solved);
  state_->setText(
      records_.empty()
          ? tr("Every run is kept here, to compare it with others and to restore it.")
          : tr("%1, %2 with a path. A double click restores a run.")
                .arg(records_.size() == 1 ? tr("1 run") : tr("%1 runs").arg(records_.size()))
                .arg(solved));
  show_actions();
}

QModelIndex RunsPanel::row_of(const std::shared_ptr<const PlanRun>& run) const {
  const auto place = std::ranges::find(records_, run, &PathRecord::run);
  return run && place != records_.end()
             ? sorted_->mapFromSource(table_->index(static_cast<int>(place - records_.begin()), 0))
             : QModelIndex();
}

void RunsPanel::show_actions() {
  restore_->setEnabled(!running_ && chosen());
  compare_->setEnabled(std::ranges::count_if(records_, &PathRecord::has_figures) > 1);
}

const PathRecord* RunsPanel::chosen() const {
  const QModelIndexList rows = view_->selectionModel()->selectedRows();
  return rows.isEmpty()
             ? nullptr
             : &records_[static_cast<std::size_t>(sorted_->mapToSource(rows.front()).row())];
}

void RunsPanel::restore() {
  if (const PathRecord* record = chosen(); record && !running_) {
    const PathRecord copy = *record;  // what is listed changes with it
    emit restore_requested(copy);
  }
}

RunsTool::RunsTool(PathHistory& history, RunsPanel& runs, PlanningSession& session,
                   PlanSettings& settings, SceneEditor& editor, QObject* parent)
    : QObject(parent), session_(session), settings_(settings), editor_(editor) {
  connect(&session_, &PlanningSession::run_ended, &history,
          [&history](const PathRecord& record) { history.add(record); });
  connect(&session_, &PlanningSession::started, &runs, [&runs, this] {
    runs.set_running(true);
    if (settings_.seeds() > 1 && is_dock_shown(runs)) {
      bring_to_front(runs);  // a dock that appears would move the view
    }
  });
  connect(&session_, &PlanningSession::optimizing_started, &runs,
          [&runs] { runs.set_running(true); });
  connect(&session_, &PlanningSession::ended, &runs, [&runs] { runs.set_running(false); });
  connect(&session_, &PlanningSession::path_changed, &runs,
          [&runs, this] { runs.mark(session_.shown_run()); });
  connect(&runs, &RunsPanel::restore_requested, this, &RunsTool::restore);
}

void RunsTool::restore(const PathRecord& record) {
  if (session_.is_running()) {
    return;
  }
  const PlanRun& run = *record.run;
  session_.forget();
  settings_.apply(run.planner);
  settings_.restore(run.request);
  if (run.state != editor_.state()) {
    editor_.apply(tr("Restore run %1").arg(run.number), run.state, {});
  }
  session_.show(record, tr("Run %1, restored.").arg(run.number));
}

void add_runs(Workbench& workbench) {
  auto* panel = new RunsPanel(workbench.history);
  workbench.own<RunsTool>(workbench.history, *panel, workbench.session, workbench.plan_settings,
                          workbench.editor);
  workbench.add_dock(DockArea::kBelow, 0, {"runs", QObject::tr("Runs"), panel});
  QObject::connect(panel, &RunsPanel::compare_requested, &workbench,
                   [&] { workbench.trigger("compare"); });
}

}  // namespace handway::gui
