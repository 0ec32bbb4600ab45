#pragma once

#include "handway/planning/core/plan_result.h"

#include <QObject>

#include <optional>

namespace handway::gui {

class Document;
class FrontierLegend;
class PlanningSession;
class SceneView;
struct PathRecord;

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
