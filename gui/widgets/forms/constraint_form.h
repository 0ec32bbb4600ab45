#pragma once

#include "handway/geometric/scene/scene.h"

#include <QWidget>

#include <optional>

class QCheckBox;

namespace handway::gui {

class PoseForm;
class QuantityField;
class ShapeForm;

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
