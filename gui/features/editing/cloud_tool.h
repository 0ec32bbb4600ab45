#pragma once

#include "handway/geometric/mesh/point_cloud.h"
#include "model/jobs/background.h"

#include <QObject>
#include <QString>

#include <filesystem>

namespace handway::planning {
struct ImportedCloud;
}

namespace handway::gui {

class Workbench;

/// Adds point clouds and depth images to the scene. Points are read and filtered in the background.
class CloudTool : public QObject {
  Q_OBJECT

 public:
  /// @param workbench outlives the tool.
  explicit CloudTool(Workbench& workbench);

  /// Asks how a file is to be added, and adds it. @param file empty: asks for one.
  void add(const QString& file);
  /// Makes the selected point cloud of other cells, as an edit. It keeps its cells if that fails.
  void set_cells(const geometric::CloudCells& cells);

 signals:
  /// The cells of the selected cloud have stayed as they are.
  void cells_kept();

 private:
  void show_added(const std::filesystem::path& file, const planning::ImportedCloud& added);

  Workbench& workbench_;
  LatestJob job_;
  LatestJob cells_;
};

}  // namespace handway::gui
