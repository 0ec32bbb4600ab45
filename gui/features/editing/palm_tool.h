#pragma once

#include "handway/geometric/math/pose.h"
#include "model/document/selection.h"

#include <QObject>

#include <memory>
#include <optional>

namespace handway::planning {
class PalmIk;
struct PalmMove;
}  // namespace handway::planning

namespace handway::gui {

class Document;
class PlanningSession;
class Posing;
class SceneEditor;
class SceneView;

/// Moves the robot as it is shown, its start or its goal by the palm: the arm follows. While start
/// or goal is dragged, so does the path.
class PalmTool : public QObject {
  Q_OBJECT

 public:
  /// All outlive it.
  PalmTool(Document& document, SceneEditor& editor, Posing& posing, PlanningSession& session,
           SceneView& view, QObject* parent = nullptr);
  ~PalmTool() override;

 signals:
  /// A pose that was typed can't be taken, in words for a person.
  void refused(const QString& title, const QString& reason);

 private:
  void use_robot();
  void drag(const SceneItem& item, const geometric::Pose& X_WP);
  /// Swings the elbow of a redundant arm while its palm is held.
  void swing(const SceneItem& item, double clicks);
  void drop(const SceneItem& item, const geometric::Pose& X_WP);
  /// Shows how near the arm gets, without changing anything.
  void refuse(const SceneItem& item, const geometric::Pose& X_WP,
              const planning::PalmMove& nearest);
  /// Continues from `q`, and shows it.
  void take(const SceneItem& item, const geometric::Configuration& q);
  /// Shows whether the palm reaches the pose that it is dragged to, and the arm's manipulability
  /// there.
  void show_reach(const geometric::Pose& X_WP, bool reached);
  void show(const SceneItem& item, const geometric::Configuration& q);
  /// Returns the moved palm; nothing if the robot has no palm to move.
  [[nodiscard]] std::optional<planning::PalmMove> moved(const SceneItem& item,
                                                        const geometric::Pose& X_WP) const;

  Document& document_;
  SceneEditor& editor_;
  Posing& posing_;
  PlanningSession& session_;
  SceneView& view_;
  std::unique_ptr<const planning::PalmIk> ik_;  ///< Null: the robot has no arm.
  /// State of the dragged item before the drag and now.
  std::optional<geometric::Configuration> before_;
  geometric::Configuration now_;
  Eigen::VectorXd direction_;  ///< Elbow's null-space direction, empty: none.
};

}  // namespace handway::gui
