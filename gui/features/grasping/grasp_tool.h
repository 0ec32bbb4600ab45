#pragma once

#include "handway/planning/core/plan_result.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/grasps/hold_test.h"
#include "handway/planning/grasps/pregrasp_search.h"
#include "model/jobs/background.h"
#include "widgets/panels/floating_card.h"

#include <QObject>
#include <QPoint>

#include <Eigen/Core>

#include <cstddef>
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
class FilmBar;
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
  /// Shows or hides the column for simulated grasps, which is empty until their results come.
  void show_tests(bool possible);
  /// Shows the grasps without tests. @param reason why they can't be simulated.
  void show_untested(const QString& reason);
  /// Shows how a row's grasp held in simulation.
  void show_hold(int index, const planning::HoldResult& result);
  /// Shows in words what is simulated at the moment; empty: the film is over.
  void show_film(const QString& what);
  [[nodiscard]] int row() const;
  [[nodiscard]] FilmBar& film() { return *film_bar_; }

 signals:
  /// The row that is looked at.
  void looked_at(int index);
  /// Plan to this one.
  void chosen(int index);
  void closed();
  /// Search no longer, and keep what was found.
  void stop_requested();
  /// Show the simulation of this one, or no longer.
  void film_wanted(int index, bool wanted);

 private:
  /// Enables the film of the row that is looked at, once it is simulated.
  void update_film();
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
  QPushButton* film_;
  FilmBar* film_bar_;
  QPushButton* plan_;
  QString note_before_film_;
  std::vector<planning::Pregrasp> listed_;
  bool is_chosen_ = false;  ///< A person has chosen the row.
};

/// A grasp that was simulated, with what is to be seen of it.
struct FilmedTest {
  planning::HoldResult result;
  std::vector<planning::HoldFrame> frames;
};

/// Plans to an object: finds grasps in the background, shows them closed as ghosts of the goal with
/// their contacts, simulates whether they hold, and plans to the chosen one.
class GraspTool : public QObject {
  Q_OBJECT

 public:
  /// All outlive it. The card floats over the view.
  /// @param make_hold_test null: grasps are not simulated.
  GraspTool(Document& document, SceneEditor& editor, PlanningSession& session, SceneView& view,
            planning::MakeHoldTest make_hold_test, QObject* parent = nullptr);

  /// Searches for grasps of the selected object.
  void begin();
  [[nodiscard]] bool is_busy() const { return job_.is_busy(); }
  [[nodiscard]] const std::vector<planning::Pregrasp>& grasps() const { return grasps_.value; }
  /// Returns the simulations of grasps() that are done, from the first.
  [[nodiscard]] const std::vector<FilmedTest>& tests() const { return tests_; }
  [[nodiscard]] bool is_testing() const { return test_job_.is_busy(); }

 signals:
  /// Emitted when there is room in the view for the handles of the selection, or not because they
  /// would hide the fingers.
  void handles_welcome(bool welcome);
  /// A grasp was chosen and is planned to.
  void planning();

 private:
  void end();
  void choose(int index);
  void look_at(int index);
  /// Simulates grasps() one after the other. @param palm link of the robot.
  void test(int palm);
  void take_test(int search, FilmedTest test);
  void begin_film(int index);
  void show_frame(int index);
  void show_scene();
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
  std::string object_;                                  ///< The one that grasps were looked for.
  Eigen::Vector3d centre_O_ = Eigen::Vector3d::Zero();  ///< Its centre of mass, m, in its frame.
  planning::Derived<std::vector<planning::Pregrasp>> grasps_;
  int search_ = 0;  ///< The number of the last search.
  std::shared_ptr<std::stop_source> ends_search_;
  planning::MakeHoldTest make_hold_test_;
  std::vector<FilmedTest> tests_;
  std::size_t filmed_ = 0;  ///< Index of the grasp whose film is shown.
  LatestJob test_job_;
  LatestJob job_;
};

/// Adds the command that finds grasps of the selected object.
void add_grasping(Workbench& workbench);

}  // namespace handway::gui
