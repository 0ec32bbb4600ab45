#pragma once

#include "handway/planning/core/plan_result.h"
#include "handway/planning/grasps/pregrasp_search.h"
#include "model/jobs/background.h"
#include "widgets/panels/floating_card.h"

#include <QObject>
#include <QPoint>

#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

class QLabel;
class QProgressBar;
class QPushButton;
class QToolButton;
class QTreeWidget;

namespace handway::gui {

class Document;
class PlanningSession;
class SceneEditor;
class SceneView;
class Workbench;

/// Floats in the corner of the view where it covers least of what is grasped: ways to do so, the
/// best first, to choose from.
class GraspCard : public FloatingCard {
  Q_OBJECT

 public:
  /// @param to_be_seen places in the host that it leaves free, if it can.
  GraspCard(QWidget* host, std::function<std::vector<QPoint>()> to_be_seen);

  void show_search(const QString& object);
  /// Shows the grasps found while the search runs. @param fraction of it that is done, in [0, 1].
  void show_progress(const std::vector<planning::Pregrasp>& grasps, double fraction);
  /// The search has ended. @param stopped before its end.
  void show_grasps(const std::vector<planning::Pregrasp>& grasps, bool stopped);
  void show_failure(const QString& object, const QString& reason);

 signals:
  /// The row that is looked at.
  void looked_at(int index);
  /// Plan to this one.
  void chosen(int index);
  void closed();
  /// Search no longer, and keep what was found.
  void stop_requested();

 private:
  void set_up(const QString& note, bool with_list, bool searching);
  /// Lists them, the row that is looked at staying the same grasp.
  void list(const std::vector<planning::Pregrasp>& grasps);
  void place() override;

  std::function<std::vector<QPoint>()> to_be_seen_;
  QLabel* title_;
  QWidget* details_;  ///< All that is hidden when it is folded.
  QToolButton* fold_;
  QLabel* note_;
  QTreeWidget* list_;
  QWidget* search_;  ///< Progress and button to end the search.
  QProgressBar* progress_;
  QPushButton* plan_;
  std::vector<planning::Pregrasp> listed_;
  bool is_chosen_ = false;  ///< A person has chosen the row.
};

/// Plans to an object: finds pre-grasps in the background, shows them as ghosts of the goal, and
/// plans to the chosen one.
class GraspTool : public QObject {
  Q_OBJECT

 public:
  /// All outlive it. The card floats over the view.
  GraspTool(Document& document, SceneEditor& editor, PlanningSession& session, SceneView& view,
            QObject* parent = nullptr);

  /// Searches for grasps of the selected object.
  void begin();
  [[nodiscard]] bool is_busy() const { return job_.is_busy(); }
  [[nodiscard]] const std::vector<planning::Pregrasp>& grasps() const { return grasps_.value; }

 signals:
  /// Emitted when there is room in the view for the handles of the selection, or not because they
  /// would hide the fingers.
  void handles_welcome(bool welcome);
  /// A grasp was chosen and is planned to.
  void planning();

 private:
  void end();
  void choose(int index);
  /// Takes the grasps that a search has found so far. @param search the number of the search.
  void take_progress(int search, std::vector<planning::Pregrasp> found, double fraction);
  /// Returns the points of the view that should stay visible: of the object, and of the hand in
  /// each of the grasps.
  [[nodiscard]] std::vector<QPoint> to_be_seen() const;

  Document& document_;
  SceneEditor& editor_;
  PlanningSession& session_;
  SceneView& view_;
  GraspCard* card_;
  std::string object_;  ///< The one that grasps were looked for.
  planning::Derived<std::vector<planning::Pregrasp>> grasps_;
  int search_ = 0;  ///< The number of the last search.
  std::shared_ptr<std::stop_source> ends_search_;
  LatestJob job_;
};

/// Adds the command that finds grasps of the selected object.
void add_grasping(Workbench& workbench);

}  // namespace handway::gui
