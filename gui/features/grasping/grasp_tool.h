#pragma once

#include "handway/planning/core/plan_result.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/grasps/given_grasps.h"
#include "handway/planning/grasps/hold_test.h"
#include "handway/planning/grasps/pregrasp_search.h"
#include "model/jobs/background.h"
#include "view3d/film.h"

#include <QObject>
#include <QPoint>

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::gui {

class Document;
class GraspCard;
enum class GraspOrigin;
class PlanningSession;
class SceneEditor;
class SceneView;
class Workbench;

/// A grasp that was simulated, with what is to be seen of it.
struct FilmedTest {
  planning::HoldResult result;
  std::vector<planning::HoldFrame> frames;
};

/// Source of a list of grasps: a search, if both are empty.
struct GraspSource {
  std::filesystem::path file = {};               ///< The scene keeps it for the object.
  std::vector<planning::GivenGrasp> given = {};  ///< Grasps that were listed before an edit.

  [[nodiscard]] GraspOrigin origin() const;
};

/// Plans to an object: finds grasps in the background, shows them closed as ghosts of the goal with
/// their contacts, simulates whether they hold, plans to the chosen one, and keeps them in a file
/// for the object, which is shown the next time. When the scene is edited, the listed grasps are
/// measured again: they follow the object.
class GraspTool : public QObject {
  Q_OBJECT

 public:
  /// All outlive it. The card floats over the view.
  /// @param make_hold_test null: grasps are not simulated.
  GraspTool(Document& document, SceneEditor& editor, PlanningSession& session, SceneView& view,
            planning::MakeHoldTest make_hold_test, QObject* parent = nullptr);

  /// Shows the grasps that the scene keeps for the selected object, or searches for grasps of it.
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
  /// Emitted when grasps were kept in that file.
  void kept(const QString& file);
  void failed(const QString& title, const QString& text);
  /// The film that is shown is to be saved.
  void pictures_wanted(const handway::gui::Film& film);

 private:
  void find(const geometric::SceneObject& object, const GraspSource& source);
  /// Shows the grasps that were found, or why there are none.
  void take(const planning::MeasuredGrasps& measured, bool stopped);
  /// Measures the grasps again in an edited scene, or searches again.
  void follow_edit();
  void keep();
  void end();
  void choose(int index);
  void look_at(int index);
  /// Simulates grasps() one after the other.
  void test();
  void take_test(int search, FilmedTest test);
  /// Lists the grasps in another order: those first that hold under more loads.
  void rank_by_tests();
  void begin_film(int index);
  /// Returns the film that is shown.
  [[nodiscard]] Film film() const;
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
  GraspSource source_;
  std::vector<planning::GivenGrasp>
      found_;       ///< Grasps that the last search has found, to follow edits.
  int palm_ = -1;   ///< Their palm: a link of the robot.
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
