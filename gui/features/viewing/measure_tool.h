#pragma once

#include "model/document/selection.h"
#include "model/jobs/background.h"
#include "widgets/panels/floating_card.h"

#include <QObject>
#include <QPoint>

#include <optional>
#include <vector>

class QAction;
class QKeyEvent;
class QLabel;
class QMouseEvent;

namespace handway::gui {

class Workbench;

/// Card at the view's lower right while distances are measured, with the result or the next step.
class MeasureCard : public FloatingCard {
  Q_OBJECT

 public:
  explicit MeasureCard(QWidget* host);

  /// @param text rich.
  void show_text(const QString& text);

 signals:
  void closed();

 private:
  void place() override;

  QLabel* text_;
};

/// Measures from one point to another that are clicked in the view, and how near the two bodies
/// come to each other. The corners of bodies attract the pointer.
class MeasureTool : public QObject {
  Q_OBJECT

 public:
  /// @param workbench outlives it.
  explicit MeasureTool(Workbench& workbench);

  /// Handles clicks and Escape in the view while it is on.
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  bool take_mouse(const QMouseEvent& event);
  void turn_on(bool on);
  /// Forgets what has been measured.
  void clear();
  void click(const QPoint& place);
  /// Shows the distance to what is under the pointer.
  void hover(const QPoint& place);
  /// Returns the point under the pointer, snapped to a near corner.
  [[nodiscard]] std::optional<SceneHit> hit_at(const QPoint& place);
  void draw(const std::optional<SceneHit>& end);
  void show_card();
  /// Computes the closest points of the two bodies, on another thread.
  void find_gap();

  Workbench& workbench_;
  QAction* action_;
  MeasureCard* card_;
  std::optional<SceneHit> from_;
  std::optional<SceneHit> to_;
  std::optional<double> gap_;  ///< Between the bodies, m.
  QPoint pressed_;
  SceneItem corners_of_;
  std::vector<Eigen::Vector3d> corners_;  ///< World, m.
  LatestJob job_;
};

}  // namespace handway::gui
