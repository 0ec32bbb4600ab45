#pragma once

#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/planning/edits/arranging.h"
#include "widgets/panels/floating_card.h"

#include <QObject>

#include <Eigen/Geometry>

class QAction;
class QCheckBox;
class QComboBox;
class QSlider;

namespace handway::gui {

class QuantityField;
class Workbench;

/// Card at the view's lower right while a section is shown, with its axis and position.
class SectionCard : public FloatingCard {
  Q_OBJECT

 public:
  explicit SectionCard(QWidget* host);

  /// Shows it. @param room where the plane may be (world, m). @param cut in front of which point.
  /// @param towards what is cut away: along this direction from there.
  void begin(const geometric::Aabb& room, const Eigen::Vector3d& cut,
             const Eigen::Vector3d& towards);
  /// Returns the section plane, above which everything is cut away; world, m.
  [[nodiscard]] Eigen::Hyperplane<double, 3> plane() const;

 signals:
  void changed();
  void closed();

 private:
  void show_axis();
  void set_place(double place);
  void place() override;

  QComboBox* axis_;
  QSlider* slider_;
  QuantityField* field_;
  QCheckBox* other_side_;
  geometric::Aabb room_;
  Eigen::Vector3d cut_ = Eigen::Vector3d::Zero();
};

/// A plane across an axis of the world that cuts away the objects on one side of it, so that one
/// sees into shelves and cages; those that close the robots in are opened with one. Robots, and
/// what they carry, are drawn whole.
class SectionTool : public QObject {
  Q_OBJECT

 public:
  /// @param workbench outlives it.
  explicit SectionTool(Workbench& workbench);

 private:
  void turn_on(bool on);
  /// Cuts open what hides the robots of a scene that was opened.
  void open_up();
  /// @param before a point (world, m) of the plane, open towards the camera.
  void cut(const Eigen::Vector3d& before);
  [[nodiscard]] planning::ObjectNames all_objects() const;

  Workbench& workbench_;
  QAction* action_;
  SectionCard* card_;
};

}  // namespace handway::gui
