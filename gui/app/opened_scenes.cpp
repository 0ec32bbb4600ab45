#include "app/file_commands.h"
#include "app/main_window.h"
#include "campaigns/campaigns_panel.h"

/// What the window opens: files, new scenes, and runs of campaigns.
namespace handway::gui {

void MainWindow::open(const QString& file) {
  if (!files_->may_discard()) {
    return;
  }
  options_ = {};
  document_.open(file.toStdString());
}

void MainWindow::create(const std::string& robot) {
  if (files_->may_discard()) {
    options_ = {};
    document_.create(robot);
  }
}

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
