#include "app/file_commands.h"
#include "app/main_window.h"
#include "features/campaigns/campaigns_panel.h"
#include "features/devices/device_session.h"
#include "features/editing/scene_editing.h"
#include "handway/geometric/io/mesh_reader.h"

#include <QDragEnterEvent>
#include <QMimeData>

/// What the window opens: files, new scenes, and runs of campaigns.
namespace handway::gui {

bool MainWindow::may_leave() { return devices_->may_leave(*this) && files_->may_discard(); }

void MainWindow::open(const QString& file) {
  if (!may_leave()) {
    return;
  }
  options_ = {};
  document_.open(file.toStdString());
}

void MainWindow::create(const std::string& robot) {
  if (may_leave()) {
    options_ = {};
    document_.create(robot);
  }
}

// A run is its problem, planner, parameters and seed: planned again, it gives the same path.
void MainWindow::connect_campaigns() {
  connect(campaigns_, &CampaignsPanel::run_chosen, this, [this](const planning::ArchivedRun& run) {
    if (may_leave()) {
      options_ = {};
      options_.play = true;
      options_.planner = run.planner.planner;
      options_.settings = run.planner.parameters;
      options_.seed = run.seed;
      document_.open(run.file);
    }
  });
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls() && event->mimeData()->urls().front().isLocalFile()) {
    event->acceptProposedAction();
  }
}

void MainWindow::dropEvent(QDropEvent* event) {
  const QString file = event->mimeData()->urls().front().toLocalFile();
  if (document_.scene() && geometric::is_mesh_file(file.toStdString())) {
    editing_->add_mesh(file);
  } else {
    open(file);
  }
}

}  // namespace handway::gui
