#include "app/planning_commands.h"

#include "app/log_panel.h"
#include "app/window_actions.h"
#include "features/planning/preset_bar.h"
#include "model/planning/planning_session.h"

namespace handway::gui {

PlanningCommands::PlanningCommands(WindowActions& actions, PlanningSession& session,
                                   PlanSettings& settings, PresetBar& presets, LogPanel& log,
                                   QObject* parent)
    : QObject(parent), actions_(actions), settings_(settings), presets_(presets), log_(log) {
  connect(actions_.plan, &QAction::triggered, &session, &PlanningSession::start);
  connect(actions_.cancel, &QAction::triggered, &session, &PlanningSession::cancel);
  connect(actions_.optimize, &QAction::triggered, &session, &PlanningSession::optimize);
  connect(&session, &PlanningSession::optimizing_started, this, [this] {
    show_running();
    log_.add(LogPanel::Level::kNote, tr("Optimising the path"));
  });
  connect(&session, &PlanningSession::started, this, &PlanningCommands::show_start);
  connect(&session, &PlanningSession::ended, this, &PlanningCommands::show_end);
  connect(&presets_, &PresetBar::failed, this, &PlanningCommands::failed);
}

void PlanningCommands::tell_of_presets() {
  if (const QString fault = presets_.store().fault(); !fault.isEmpty()) {
    emit failed(
        tr("Your presets can't be read"),
        tr("%1. The file stays as it is; once a preset is saved it is put aside.").arg(fault));
  }
}

void PlanningCommands::show_running() {
  actions_.plan->setEnabled(false);
  actions_.cancel->setEnabled(true);
}

void PlanningCommands::show_start() {
  show_running();
  const qulonglong first = settings_.request().seed;
  const QString seeds = settings_.seeds() > 1
                            ? tr("seeds %1 to %2")
                                  .arg(first)
                                  .arg(first + static_cast<qulonglong>(settings_.seeds()) - 1)
                            : tr("seed %1").arg(first);
  log_.add(
      LogPanel::Level::kNote,
      tr("Planning with %1, %2").arg(QString::fromStdString(settings_.planner()->name()), seeds));
}

void PlanningCommands::show_end(bool solved, const QString& text) {
  actions_.plan->setEnabled(true);
  actions_.cancel->setEnabled(false);
  log_.add(solved ? LogPanel::Level::kNote : LogPanel::Level::kWarning, text);
}

}  // namespace handway::gui
