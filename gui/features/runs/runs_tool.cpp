#include "features/runs/runs_tool.h"

#include "features/planning/plan_panel.h"
#include "features/runs/runs_panel.h"
#include "model/document/scene_editor.h"
#include "model/planning/planning_session.h"
#include "widgets/panels/front_page.h"

namespace handway::gui {

RunsTool::RunsTool(PathHistory& history, RunsPanel& runs, PlanningSession& session,
                   PlanPanel& panel, SceneEditor& editor, QObject* parent)
    : QObject(parent), session_(session), panel_(panel), editor_(editor) {
  connect(&session_, &PlanningSession::run_ended, &history,
          [&history](const PathRecord& record) { history.add(record); });
  connect(&session_, &PlanningSession::started, &runs, [&runs, this] {
    runs.set_running(true);
    if (panel_.seeds() > 1) {
      bring_to_front(runs);
    }
  });
  connect(&session_, &PlanningSession::optimizing_started, &runs,
          [&runs] { runs.set_running(true); });
  connect(&panel_, &PlanPanel::runs_requested, &runs, [&runs] { bring_to_front(runs); });
  connect(&session_, &PlanningSession::ended, &runs, [&runs] { runs.set_running(false); });
  connect(&session_, &PlanningSession::path_changed, &runs,
          [&runs, this] { runs.mark(session_.shown_run()); });
  connect(&editor_.document(), &Document::opened, &runs, &RunsPanel::begin_anew);
  connect(&runs, &RunsPanel::restore_requested, this, &RunsTool::restore);
}

void RunsTool::restore(const PathRecord& record) {
  if (session_.is_running()) {
    return;
  }
  const PlanRun& run = *record.run;
  session_.forget();
  panel_.apply(run.planner);
  panel_.restore(run.request);
  if (run.state != editor_.state()) {
    editor_.apply(tr("Restore run %1").arg(run.number), run.state, {});
  }
  session_.show(record, tr("Run %1, restored.").arg(run.number));
}

}  // namespace handway::gui
