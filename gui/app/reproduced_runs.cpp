#include "app/file_commands.h"
#include "app/main_window.h"
#include "campaigns/campaigns_panel.h"

namespace handway::gui {

// A run is its problem, planner, parameters and seed: planned again, it gives the same path.
void MainWindow::connect_campaigns() {
  connect(campaigns_, &CampaignsPanel::run_chosen, this, [this](const planning::ArchivedRun& run) {
    if (files_->may_discard()) {
      options_ = {};
      options_.play = true;
      options_.planner = run.planner.planner;
      options_.settings = run.planner.parameters;
      options_.seed = run.seed;
      document_.open(run.file);
    }
  });
}

}  // namespace handway::gui
