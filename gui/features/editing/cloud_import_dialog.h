#pragma once

#include "handway/geometric/formats/depth_image.h"
#include "handway/planning/edits/cloud_import.h"

#include <QDialog>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

class QCheckBox;
class QDoubleSpinBox;
class QFormLayout;

namespace handway::gui {

class PoseForm;
class QuantityField;

/// Asks where a point cloud or a depth image was taken, and what of it becomes solid.
class CloudImportDialog : public QDialog {
  Q_OBJECT

 public:
  /// @param selected objects, whose points may be left out.
  CloudImportDialog(const std::filesystem::path& file, const std::vector<std::string>& selected,
                    QWidget* parent = nullptr);

  /// Returns the settings of the import. The cells of an octomap are its own: see has_own_cells().
  [[nodiscard]] planning::CloudImport import() const;
  /// The camera of a depth image; nothing for a file of points.
  [[nodiscard]] std::optional<geometric::DepthCamera> camera() const;
  /// Returns whether the file's cells are taken.
  [[nodiscard]] bool has_own_cells() const { return has_own_cells_; }

 private:
  void add_camera(QFormLayout& form);
  void add_place(QFormLayout& form);
  void add_cells(QFormLayout& form);
  void add_filters(QFormLayout& form);

  std::filesystem::path file_;
  std::vector<std::string> selected_;
  bool is_image_;
  bool has_own_cells_;
  std::vector<QDoubleSpinBox*> camera_;  ///< fx, fy, cx, cy in pixels, millimetres for 1.
  PoseForm* place_;
  geometric::Pose X_WC_ = geometric::Pose::Identity();
  QCheckBox* optical_;
  QuantityField* cell_;
  QuantityField* radius_;
  QCheckBox* robots_;
  QuantityField* margin_;
  QCheckBox* outliers_;
  QCheckBox* finds_objects_;
  QCheckBox* hidden_;
  QCheckBox* cut_out_ = nullptr;  ///< Null without selected objects.
};

}  // namespace handway::gui
