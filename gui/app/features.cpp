#include "app/features.h"

#include "features/campaigns/campaigns_panel.h"
#include "features/comparison/comparison_window.h"
#include "features/devices/devices.h"
#include "features/editing/scene_editing.h"
#include "features/export/export_dialog.h"
#include "features/glove/glove_panel.h"
#include "features/grasping/grasp_tool.h"
#include "features/microscope/microscope_panel.h"
#include "features/planning/planning_commands.h"
#include "features/playback/plots_panel.h"
#include "features/postures/posture_panels.h"
#include "features/preferences/preferences_dialog.h"
#include "features/robots/robots.h"
#include "features/runs/runs_panel.h"
#include "features/tasks/task_tool.h"
#include "features/tracker/wrist_page.h"
#include "features/viewing/saved_views.h"

namespace handway::gui {

void add_features(Workbench& workbench) {
  add_postures(workbench);
  add_devices(workbench);
  add_playback(workbench);
  add_microscope(workbench);
  add_editing(workbench);
  add_robots(workbench);
  add_planning(workbench);
  add_grasping(workbench);
  add_tasks(workbench);
  add_glove(workbench);
  add_tracker(workbench);
  add_runs(workbench);
  add_comparison(workbench);
  add_export(workbench);
  add_campaigns(workbench);
  add_preferences(workbench);
  add_viewing(workbench);
}

}  // namespace handway::gui
