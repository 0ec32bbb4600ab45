#include "features/editing/cloud_tool.h"

#include "features/editing/cloud_import_dialog.h"
#include "features/workbench.h"
#include "handway/geometric/formats/cloud_reader.h"
#include "handway/planning/edits/cloud_import.h"
#include "model/document/scene_editor.h"
#include "view3d/scene_view.h"
#include "widgets/panels/log_panel.h"

#include <QFileDialog>
#include <QMainWindow>
#include <QStatusBar>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::gui {
namespace {

/// A file of points that is read and filtered in the background.
struct CloudRequest {
  std::filesystem::path file;
  std::shared_ptr<const geometric::Scene> scene;
  geometric::Configuration q;
  planning::CloudImport import;
  std::optional<geometric::DepthCamera> camera;
  bool has_own_cells = false;

  [[nodiscard]] planning::ImportedCloud run() {
    geometric::PointCloud cloud =
        camera ? geometric::read_depth_image(file, *camera) : geometric::read_cloud(file).cloud;
    if (has_own_cells) {
      import.cells = geometric::usual_cells(cloud);
    }
    return planning::import_cloud(*scene, q, std::move(cloud), import, file.string());
  }
};

}  // namespace

CloudTool::CloudTool(Workbench& workbench) : workbench_(workbench) {
  connect(&workbench_, &Workbench::cloud_dropped, this, &CloudTool::add);
  connect(&workbench_, &Workbench::scene_shown, &job_, &LatestJob::cancel);
  connect(&job_, &LatestJob::failed, this, [this](const QString& message) {
    workbench_.window.statusBar()->clearMessage();
    workbench_.show_error(tr("The points can't be added"), message);
  });
  connect(&workbench_, &Workbench::scene_shown, &cells_, &LatestJob::cancel);
  connect(&cells_, &LatestJob::failed, this, [this](const QString& message) {
    workbench_.show_error(tr("The cells can't be changed"), message);
    emit cells_kept();
  });
  workbench_.add_work([this] { return job_.is_busy() || cells_.is_busy(); });
}

void CloudTool::add(const QString& file) {
  const QString chosen =
      file.isEmpty() ? QFileDialog::getOpenFileName(
                           &workbench_.window, tr("Add a point cloud"), {},
                           tr("Point clouds (*.pcd *.ply *.xyz *.pts *.asc *.txt *.csv *.npy *.bt "
                              "*.ot);;Depth images (*.png);;All files (*)"))
                     : file;
  if (chosen.isEmpty() || !workbench_.document.scene()) {
    return;
  }
  CloudRequest request;
  request.file = std::filesystem::absolute(chosen.toStdString());
  CloudImportDialog dialog(request.file, workbench_.editor.selected_objects(), &workbench_.window);
  if (dialog.exec() != QDialog::Accepted) {
    return;
  }
  request.scene = workbench_.document.scene();
  request.q = workbench_.document.configuration();
  request.import = dialog.import();
  request.camera = dialog.camera();
  request.has_own_cells = dialog.has_own_cells();
  workbench_.window.statusBar()->showMessage(tr("Reading %1…").arg(chosen));
  job_.run([this, request = std::move(request)](const std::stop_token& /*stop*/) mutable {
    auto added = std::make_shared<planning::ImportedCloud>(request.run());
    return [this, added, file = request.file] { show_added(file, *added); };
  });
}

void CloudTool::set_cells(const geometric::CloudCells& cells) {
  const geometric::SceneObject* object = workbench_.editor.selected_object();
  const auto* cloud = object ? std::get_if<geometric::Cloud>(&object->shape) : nullptr;
  if (cloud == nullptr || cloud->cells == cells) {
    return;
  }
  cells_.run([this, name = object->name, points = cloud->points, file = cloud->file,
              cells](const std::stop_token& /*stop*/) -> LatestJob::Answer {
    auto made = std::make_shared<geometric::Cloud>(geometric::make_cloud(points, cells, name));
    made->file = file;
    return [this, name, made] {
      const geometric::SceneObject* now = workbench_.editor.selected_object();
      const auto* same = now ? std::get_if<geometric::Cloud>(&now->shape) : nullptr;
      if (same != nullptr && now->name == name && same->points == made->points) {
        workbench_.editor.set_shape(*made);
      }
    };
  });
}

void CloudTool::show_added(const std::filesystem::path& file,
                           const planning::ImportedCloud& added) {
  workbench_.window.statusBar()->clearMessage();
  workbench_.editor.add_objects(added.objects);
  workbench_.view.keep_selection_in_view();
  if (added.objects.size() > 1) {
    workbench_.editor.select_objects({});  // each is clicked on by itself
  }
  workbench_.log.add(
      LogPanel::Level::kNote,
      tr("Added %1: %2 points, %3 primitives. Left out: %4 points of the robot or of "
         "objects, %5 single")
          .arg(QString::fromStdString(file.filename().string()))
          .arg(added.points)
          .arg(added.objects.size() - (added.points > 0 ? 1 : 0) - (added.hidden > 0 ? 1 : 0))
          .arg(added.of_bodies)
          .arg(added.outliers));
}

}  // namespace handway::gui
