#pragma once

#include "handway/planning/core/plan_result.h"
#include "widgets/panels/floating_card.h"

#include <QObject>

#include <optional>
#include <string>
#include <vector>

class QGridLayout;
class QLabel;

namespace handway::gui {

class Document;
class PlanningSession;
class SceneView;
struct PathRecord;

/// Floats in a corner of the view: which ghost is where a search without a path came to from the
/// start and from the goal, and what collided most.
class FrontierLegend : public FloatingCard {
  Q_OBJECT

 public:
  explicit FrontierLegend(QWidget* host);

  /// @param colliding the bodies that collided most; may be empty.
  void show_frontier(const planning::SearchReach& reach, const std::vector<std::string>& colliding);

 signals:
  /// Show the robot at one of the two.
  void visited(bool from_start);
  void closed();

 private:
  void place() override;
  QLabel* add_row(QGridLayout& rows, const char* name, bool from_start);

  QLabel* from_start_;
  QLabel* from_goal_;
  QLabel* colliding_;
};

/// Shows in the view how far a search that found no path came from both ends, until the next run
/// or edit.
class FrontierDisplay : public QObject {
  Q_OBJECT

 public:
  /// All outlive it.
  FrontierDisplay(Document& document, PlanningSession& session, SceneView& view,
                  QObject* parent = nullptr);

  /// Null: nothing is shown.
  [[nodiscard]] const planning::SearchReach* shown() const {
    return shown_ ? &*shown_->reach : nullptr;
  }

 private:
  void note(const PathRecord& record);
  void show();
  void clear();

  Document& document_;
  SceneView& view_;
  FrontierLegend* legend_;
  std::optional<planning::PlanResult> last_;   ///< Of the run that goes on; has a reach.
  std::optional<planning::PlanResult> shown_;  ///< Has a reach.
};

}  // namespace handway::gui
