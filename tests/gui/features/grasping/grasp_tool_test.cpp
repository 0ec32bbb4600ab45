#include "features/grasping/grasp_tool.h"

#include "features/editing/editing_test.h"
#include "view3d/scene_view.h"
#include "view3d/view_gizmo.h"

#include <QAction>
#include <QApplication>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QTimer>
#include <QTreeWidget>

namespace handway::test {
namespace {

class ClickToPlan : public EditingTest {
 protected:
  void grasp(const char* object) {
    select(object);
    part<QAction>("posture").trigger();
    ASSERT_TRUE(QTest::qWaitFor([&] { return !tool<gui::GraspTool>().is_busy(); }, 120000));
  }
};

TEST_F(ClickToPlan, PlansToTheGraspThatIsChosen) {
  open(source_dir() / "scenes" / "can_on_table.yaml");
  const geometric::Configuration before = *scene().goal;
  grasp("can");
  const std::vector<planning::Pregrasp> grasps = tool<gui::GraspTool>().grasps();
  ASSERT_FALSE(grasps.empty());
  auto& list = part<QTreeWidget>("grasp_list");
  EXPECT_EQ(list.topLevelItemCount(), static_cast<int>(grasps.size()));
  EXPECT_EQ(*scene().goal, before) << "only looked at";
  EXPECT_FALSE(window().view().gizmo().is_shown()) << "it would hide the fingers";
  keep_picture("click_to_plan");
  QSignalSpy started(&window().session(), &gui::PlanningSession::started);
  click("grasp_plan");
  EXPECT_EQ(started.count(), 1);
  EXPECT_EQ(*scene().goal, grasps.front().q);
  EXPECT_EQ(editor().undo_stack().undoText(), "Set goal");
  window().session().cancel();
  EXPECT_TRUE(QTest::qWaitFor([&] { return !window().session().is_running(); }, 8000));
}

/// With the plugins that are built.
class ClickToSimulate : public ClickToPlan {
 protected:
  [[nodiscard]] std::shared_ptr<planning::PluginManager> plugins() const override {
    auto loaded = std::make_shared<planning::PluginManager>();
    loaded->load_plugins(planning::plugin_directory());
    return loaded;
  }
};

TEST_F(ClickToSimulate, ShowsWhatIsHeldAndTheFilm) {
  open(source_dir() / "scenes" / "can_on_table.yaml");
  grasp("can");
  gui::GraspTool& grasping = tool<gui::GraspTool>();
  auto& list = part<QTreeWidget>("grasp_list");
  auto& film = part<QPushButton>("grasp_film");
  constexpr int kHeld = 5;
  if (list.isColumnHidden(kHeld)) {
    EXPECT_FALSE(film.isVisible());
    GTEST_SKIP() << "built without MuJoCo";
  }
  ASSERT_TRUE(QTest::qWaitFor([&] { return !grasping.is_testing(); }, 120000));
  ASSERT_EQ(grasping.tests().size(), grasping.grasps().size());
  EXPECT_EQ(list.topLevelItem(0)->text(kHeld), "6 of 6");
  EXPECT_TRUE(list.topLevelItem(0)->toolTip(kHeld).contains("Raised by 10 cm"));
  const planning::SceneState before = editor().state();
  click("grasp_film");
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return part<QLabel>("grasp_note").text().contains("1 N along"); }, 20000));
  keep_picture("grasp_film");
  EXPECT_EQ(film.text(), "Stop");
  EXPECT_EQ(editor().state(), before) << "only shown";
  click("grasp_film");
  EXPECT_EQ(film.text(), "Watch the test");
  EXPECT_FALSE(part<QLabel>("grasp_note").text().contains("Simulation"));
}

TEST_F(ClickToPlan, KeepsGraspsForTheObject) {
  open(source_dir() / "scenes" / "can_on_table.yaml");
  grasp("can");
  const std::size_t found = tool<gui::GraspTool>().grasps().size();
  const ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "can grasps.yaml";
  QTimer::singleShot(300, [&file] {
    auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
    ASSERT_TRUE(dialog);
    auto* field = dialog->findChild<QLineEdit*>();
    EXPECT_EQ(field->text(), "can_on_table_can_grasps.yaml");
    field->selectAll();
    QTest::keyClicks(field, QString::fromStdString(file.string()));
    QTest::keyClick(field, Qt::Key_Return);
  });
  click("grasp_keep");
  ASSERT_TRUE(QTest::qWaitFor([&] { return !tool<gui::GraspTool>().is_busy(); }, 120000));
  EXPECT_EQ(geometric::find_object(scene(), "can")->grasps, file);
  EXPECT_EQ(editor().undo_stack().undoText(), "Keep grasps of can");
  EXPECT_TRUE(part<QLabel>("grasp_note").text().startsWith("Kept in can grasps.yaml."));
  EXPECT_EQ(tool<gui::GraspTool>().grasps().size(), found);
  keep_picture("kept_grasps");
  click("grasp_search");
  EXPECT_TRUE(QTest::qWaitFor([&] { return !tool<gui::GraspTool>().is_busy(); }, 120000));
  EXPECT_TRUE(part<QLabel>("grasp_note").text().startsWith("The best grasp is first"));
}

TEST_F(ClickToPlan, MeasuresTheGraspsAgainWhereTheObjectIsMoved) {
  open(source_dir() / "scenes" / "can_on_table.yaml");
  grasp("can");
  const std::vector<planning::Pregrasp> before = tool<gui::GraspTool>().grasps();
  ASSERT_FALSE(before.empty());
  const auto move_can = [this](double distance) {
    geometric::Pose moved = geometric::find_object(scene(), "can")->X_PO;
    moved.translation().y() += distance;
    editor().place(moved);
    ASSERT_TRUE(QTest::qWaitFor([&] { return !tool<gui::GraspTool>().is_busy(); }, 120000));
  };
  move_can(0.02);
  const std::vector<planning::Pregrasp> after = tool<gui::GraspTool>().grasps();
  ASSERT_FALSE(after.empty());
  EXPECT_NE(after.front().q, before.front().q);
  EXPECT_NEAR(after.front().quality.epsilon, before.front().quality.epsilon, 0.02)
      << "the hand holds it as before";
  EXPECT_TRUE(part<QLabel>("grasp_note").text().startsWith("Measured again"));
  keep_picture("followed_grasps");
  move_can(5.0);
  EXPECT_TRUE(tool<gui::GraspTool>().grasps().empty());
  EXPECT_THAT(part<QLabel>("grasp_note").text().toStdString(),
              ::testing::HasSubstr("not possible here: Grasp 1"));
  EXPECT_TRUE(part<QPushButton>("grasp_search").isVisible());
  move_can(-5.02);
  EXPECT_EQ(tool<gui::GraspTool>().grasps().size(), before.size());
}

TEST_F(ClickToPlan, LeavesTheGoalWhenTheListIsClosed) {
  open(source_dir() / "scenes" / "can_on_table.yaml");
  const planning::SceneState before = editor().state();
  grasp("can");
  click("grasp_close");
  EXPECT_EQ(editor().state(), before);
  EXPECT_TRUE(tool<gui::GraspTool>().grasps().empty());
  EXPECT_TRUE(window().view().gizmo().is_shown());
}

TEST_F(ClickToPlan, KeepsItsListOffTheObjectAndTheHand) {
  for (const char* scene : {"can_on_table", "can_in_box", "cans_in_shelf", "panda_and_leap"}) {
    window().resize(1290, 830);
    open(source_dir() / "scenes" / (std::string(scene) + ".yaml"));
    const char* object = scene == std::string("panda_and_leap") ? "mug" : "can";
    grasp(object);
    ASSERT_FALSE(tool<gui::GraspTool>().grasps().empty()) << scene;
    const gui::SceneView& view = window().view();
    const auto is_covered = [&](const Eigen::Vector3d& p_W) {
      return part<QWidget>("grasps").geometry().contains(
          gui::place_of(view.camera(), view.size(), p_W).toPoint());
    };
    const geometric::Scene& shown = *window().document().scene();
    EXPECT_FALSE(is_covered(geometric::find_object(shown, object)->X_PO.translation())) << scene;
    const geometric::RobotInstance& robot = shown.robots.front();
    const geometric::Configuration q = tool<gui::GraspTool>().grasps().front().q;
    std::vector<geometric::Pose> X_BL(static_cast<std::size_t>(robot.model->link_count()));
    robot.model->forward_kinematics(q, X_BL);
    const auto palm = static_cast<std::size_t>(window().document().palm());
    EXPECT_FALSE(is_covered(robot.X_WB * X_BL[palm].translation())) << scene;
    click("grasp_fold");
    EXPECT_FALSE(part<QTreeWidget>("grasp_list").isVisible());
    EXPECT_TRUE(part<QWidget>("grasp_plan").isVisible());
    click("grasp_close");
  }
}

TEST_F(ClickToPlan, ShowsTheGoalAgainThatIsPlannedTo) {
  open(source_dir() / "scenes" / "can_on_table.yaml");
  grasp("can");
  plan();
  EXPECT_FALSE(part<QWidget>("grasps").isVisible()) << "the path goes elsewhere";
  EXPECT_TRUE(tool<gui::GraspTool>().grasps().empty());
}

TEST_F(ClickToPlan, SaysWhenThereIsNoWay) {
  open(source_dir() / "scenes" / "can_on_table.yaml");
  grasp("table");
  EXPECT_TRUE(tool<gui::GraspTool>().grasps().empty());
  EXPECT_THAT(part<QLabel>("grasp_note").text().toStdString(), ::testing::HasSubstr("too large"));
}

}  // namespace
}  // namespace handway::test
