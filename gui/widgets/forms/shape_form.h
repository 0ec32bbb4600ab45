#pragma once

#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/scene/scene.h"

#include <QWidget>

#include <optional>
#include <vector>

class QDoubleSpinBox;
class QFormLayout;

class QCheckBox;

namespace handway::gui {

class QuantityField;

/// The measures of a shape, typed: edges, radius, length; of a mesh its scale.
class ShapeForm : public QWidget {
  Q_OBJECT

 public:
  explicit ShapeForm(QWidget* parent = nullptr);

  void show_shape(const geometric::Shape& shape);
  void set_editable(bool editable);

 signals:
  void shape_edited(const handway::geometric::Shape& shape);

 private:
  void rebuild();
  void take_values();
  void add_scale();
  void add_field(const QString& label, const char* name);

  QFormLayout* layout_;
  std::vector<QuantityField*> fields_;
  QDoubleSpinBox* scale_ = nullptr;  ///< Scale of a mesh.
  geometric::Shape shape_;
  bool editable_ = true;
};

/// Returns the displayed kind of a shape: "Box", "Cylinder", …
[[nodiscard]] QString kind_of_shape(const geometric::Shape& shape);

class PoseForm;

/// Form of a body's constraints along paths: an angle to the upright, a region. Each can be
/// switched on, which makes one, changed, and switched off.
class ConstraintForm : public QWidget {
  Q_OBJECT

 public:
  explicit ConstraintForm(QWidget* parent = nullptr);

  /// Shows the constraint; nothing: there is none of that kind.
  void show_upright(const std::optional<geometric::OrientationConstraint>& upright);
  void show_region(const std::optional<geometric::PositionConstraint>& region);

 signals:
  /// A person has switched one on or off.
  void upright_switched(bool on);
  void region_switched(bool on);
  /// A person has changed the one that is shown.
  void upright_edited(const handway::geometric::OrientationConstraint& upright);
  void region_edited(const handway::geometric::PositionConstraint& region);

 private:
  geometric::OrientationConstraint upright_;
  geometric::PositionConstraint region_;
  QCheckBox* upright_on_;
  QuantityField* angle_;
  QCheckBox* region_on_;
  QWidget* region_box_;
  ShapeForm* size_;
  PoseForm* centre_;
};

}  // namespace handway::gui
