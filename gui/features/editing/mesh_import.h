#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <QDialog>
#include <QPixmap>

#include <memory>

class QCheckBox;
class QComboBox;
class QLabel;

namespace handway::gui {

/// Asks for the unit and the up axis of a mesh file, and shows the result: sizes, and a picture
/// with the height of a person's hand beside it.
class MeshImportDialog : public QDialog {
  Q_OBJECT

 public:
  /// @param mesh its numbers taken as metres and as they stand in the file.
  /// @param knows_units whether the format says what its numbers and axes are.
  MeshImportDialog(const QString& file, std::shared_ptr<const geometric::TriangleMesh> mesh,
                   bool knows_units, QWidget* parent = nullptr);

  /// m for each unit of the file.
  [[nodiscard]] double scale() const;
  /// Rotation of the file's axes in the world.
  [[nodiscard]] Eigen::Matrix3d orientation() const;
  /// Returns whether only the walls of the mesh collide.
  [[nodiscard]] bool is_hollow() const;

 private:
  void show_result();

  std::shared_ptr<const geometric::TriangleMesh> mesh_;
  QComboBox* unit_;
  QComboBox* up_;
  QLabel* size_;
  QLabel* picture_;
  QCheckBox* hollow_;
};

}  // namespace handway::gui
