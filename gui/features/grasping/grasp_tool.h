#pragma once

#include "handway/planning/core/revision.h"
#include "handway/planning/grasps/pregrasp_search.h"
#include "model/jobs/latest_job.h"

#include <QObject>

#include <string>
#include <vector>

namespace handway::gui {

class Document;
class GraspCard;
class PlanningSession;
class SceneEditing;
class SceneEditor;
class SceneView;

/// From an object to a plan: finds pre-grasps in the background, shows them as ghosts of the goal,
/// and plans to the one that is chosen.
class GraspTool : public QObject {
  Q_OBJECT

 public:
  /// All outlive it. The card floats over the view.
  GraspTool(Document& document, SceneEditing& editing, PlanningSession& session, SceneView& view,
            QObject* parent = nullptr);

  /// Looks for ways to grasp the selected object.
  void begin();
  [[nodiscard]] bool is_busy() const { return job_.is_busy(); }
  [[nodiscard]] const std::vector<planning::Pregrasp>& grasps() const { return grasps_.value; }

 private:
  void end();
  void choose(int index);

  Document& document_;
  SceneEditing& editing_;
  SceneEditor& editor_;
  PlanningSession& session_;
  SceneView& view_;
  GraspCard* card_;
  planning::Derived<std::vector<planning::Pregrasp>> grasps_;
  LatestJob job_;
};

}  // namespace handway::gui
