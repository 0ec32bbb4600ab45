/// Goals as poses in the window: added, dragged, changed in numbers, planned to.
#include "features/editing/editing_test.h"
#include "features/editing/goal_pose_form.h"
#include "features/editing/properties_panel.h"
#include "features/editing/scene_tree.h"
#include "patience.h"
#include "pressed_mouse.h"
#include "widgets/forms/pose_form.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QScrollBar>
#include <QTreeWidget>

#include <numbers>

namespace handway::test {
namespace {

using Kind = gui::SceneItem::Kind;

class GoalPoses : public EditingTest {
 protected:
  void add() const {
    window().document().set_configuration(Eigen::Vector4d(0.9, 0.8, 0, 0));
    part<QAction>("add_goal_pose").trigger();
  }
  [[nodiscard]] const geometric::PoseGoal& goal() const { return scene().goal_poses.front(); }
  /// Drags the pose along its y axis, by `lengths` of an arrow.
  void pull(double lengths, bool let_go = true) const {
    gui::SceneView& view = window().view();
    QTest::qWait(50);
    const gui::GizmoFrame frame = view.gizmo().frame(view.camera(), view.size());
    const QPoint from = seen(frame.centre + 0.9 * frame.size * frame.axes.col(1));
    const QPoint to = seen(frame.centre + (0.9 + lengths) * frame.size * frame.axes.col(1));
    QTest::mousePress(&view, Qt::LeftButton, {}, from);
    ASSERT_TRUE(view.gizmo().is_dragging());
    move_pressed_mouse(view, 0.5 * (from + to));
    move_pressed_mouse(view, to);
    if (let_go) {
      QTest::mouseRelease(&view, Qt::LeftButton, {}, to);
    }
  }
};

TEST_F(GoalPoses, AreAddedWhereThePalmIsAndDeleted) {
  add();
  ASSERT_EQ(scene().goal_poses.size(), 1U);
  EXPECT_EQ(goal().link, "palm");
  EXPECT_TRUE(goal().X_WG.isApprox(
      *geometric::link_pose(scene(), window().document().configuration(), "arm", "palm")));
  EXPECT_EQ(editor().selection().kind, Kind::kGoalPose);
  EXPECT_TRUE(window().view().gizmo().is_shown());
  EXPECT_EQ(window()
                .findChild<gui::SceneTree*>()
                ->findItems(QStringLiteral("Goal pose of palm"), Qt::MatchRecursive)
                .size(),
            1);
  keep_picture("goal_pose");
  part<QAction>("delete").trigger();
  EXPECT_TRUE(scene().goal_poses.empty());
  editor().undo_stack().undo();
  EXPECT_EQ(scene().goal_poses.size(), 1U);
  editor().undo_stack().undo();
  EXPECT_TRUE(scene().goal_poses.empty());
  EXPECT_NE(editor().selection().kind, Kind::kGoalPose);
}

TEST_F(GoalPoses, AreChangedInNumbers) {
  add();
  type("position_x", "350 mm");
  EXPECT_NEAR(goal().X_WG.translation().x(), 0.35, 1e-12);
  type("goal_position_tolerance", "5 mm");
  EXPECT_NEAR(goal().position_tolerance.minCoeff(), 0.005, 1e-12);
  part<QCheckBox>("goal_free_z").click();
  EXPECT_GE(goal().rotation_tolerance.z(), std::numbers::pi);
  type("goal_rotation_tolerance", "3°");
  EXPECT_NEAR(goal().rotation_tolerance.x(), geometric::radians(3), 1e-9);
  EXPECT_GE(goal().rotation_tolerance.z(), std::numbers::pi) << "still free";
  EXPECT_EQ(editor().undo_stack().undoText(), "Change goal pose");
}

TEST_F(GoalPoses, MoveWithAnObject) {
  add();
  click("goal_tool_fold");
  auto& with = part<QComboBox>("goal_object");
  EXPECT_EQ(with.currentText(), "Nothing");
  QTest::keyClick(&with, Qt::Key_Down);
  const std::string object = with.currentText().toStdString();
  EXPECT_EQ(goal().reference, object);
  const geometric::Pose before = goal().X_WG;
  const double x = geometric::find_object(scene(), object)->X_PO.translation().x();
  select(object.c_str());
  type("position_x", "450 mm");
  EXPECT_NEAR(goal().X_WG.translation().x(), before.translation().x() + 0.45 - x, 1e-9);
  editor().undo_stack().undo();
  EXPECT_TRUE(goal().X_WG.isApprox(before, 1e-12));
}

TEST_F(GoalPoses, HaveAFormThatFitsAndUnfoldsTheTool) {
  window().resize(1440, 900);
  add();
  auto& form = tool<gui::GoalPoseForm>();
  QTest::qWait(100);
  const QScrollBar& scroll = *tool<gui::PropertiesPanel>().verticalScrollBar();
  EXPECT_EQ(scroll.maximum(), 0);
  keep_picture("goal_form");
  auto& tool_pose = *form.findChild<gui::PoseForm*>();
  EXPECT_FALSE(tool_pose.isVisible());
  click("goal_tool_fold");
  EXPECT_TRUE(tool_pose.isVisible());
  click("goal_tool_fold");
  geometric::PoseGoal elsewhere = goal();
  elsewhere.X_LT.translation().z() = 0.1;
  form.show_goal(scene(), elsewhere);
  EXPECT_TRUE(tool_pose.isVisible()) << "a tool that is not at the link's frame is seen";
}

TEST_F(GoalPoses, AreDraggedAndPlannedTo) {
  add();
  const double before = goal().X_WG.translation().y();
  const geometric::Pose there = goal().X_WG;
  pull(0.5);
  EXPECT_GT(goal().X_WG.translation().y(), before + 0.005);
  EXPECT_EQ(editor().undo_stack().undoText(), "Move goal pose");
  editor().undo_stack().undo();
  EXPECT_TRUE(goal().X_WG.isApprox(there));
  plan();
  const planning::Path& path = window().player().timeline().path();
  ASSERT_FALSE(path.empty());
  EXPECT_LT((geometric::link_pose(scene(), path.waypoints.back(), "arm", "palm")->translation() -
             there.translation())
                .norm(),
            1e-3);
}

TEST_F(GoalPoses, ComeBackOnEscape) {
  add();
  const geometric::Pose there = goal().X_WG;
  pull(0.5, false);
  QTest::keyClick(&window().view(), Qt::Key_Escape);
  EXPECT_TRUE(goal().X_WG.isApprox(there));
  EXPECT_EQ(editor().undo_stack().undoText(), "Add goal pose");
}

TEST_F(GoalPoses, StandBesideEachOther) {
  add();
  add();
  EXPECT_EQ(scene().goal_poses.size(), 2U);
  EXPECT_EQ(editor().selection().name, "1");
  EXPECT_EQ(window()
                .findChild<gui::SceneTree*>()
                ->findItems(QStringLiteral("Goal pose 2 of palm"), Qt::MatchRecursive)
                .size(),
            1);
}

}  // namespace
}  // namespace handway::test
