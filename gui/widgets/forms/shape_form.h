#pragma once

#include "handway/geometric/mesh/shape.h"

#include <QWidget>

#include <vector>

class QDoubleSpinBox;
class QFormLayout;
class QLabel;

namespace handway::gui {

class QuantityField;

/// The measures of a shape, typed: edges, radius, length; of a mesh its scale, of a point cloud its
/// cells.
class ShapeForm : public QWidget {
  Q_OBJECT

 public:
  explicit ShapeForm(QWidget* parent = nullptr);
  /// Ends an edit of a focused field while the shape that it changes still exists.
  ~ShapeForm() override;

  void show_shape(const geometric::Shape& shape);
  void set_editable(bool editable);

 signals:
  void shape_edited(const handway::geometric::Shape& shape);
  /// Other cells were typed for a point cloud: to make them takes a while.
  void cells_edited(const handway::geometric::CloudCells& cells);

 private:
  void rebuild();
  void take_values();
  void add_scale();
  // Lengths in m.
  void add_field(const QString& label, const char* name, double least = 1e-4, double most = 100.0);

  QFormLayout* layout_;
  std::vector<QuantityField*> fields_;
  QLabel* mesh_ = nullptr;           ///< File and size of a mesh.
  QDoubleSpinBox* scale_ = nullptr;  ///< Scale of a mesh.
  geometric::Shape shape_;
  bool editable_ = true;
};

/// Returns the displayed kind of a shape: "Box", "Cylinder", …
[[nodiscard]] QString kind_of_shape(const geometric::Shape& shape);

}  // namespace handway::gui
