#include "features/editing/editing_test.h"
#include "features/editing/scene_tree.h"
#include "features/planning/plan_panel.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/planning/edits/scene_edits.h"
#include "pressed_mouse.h"
#include "view3d/scene_view.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLineEdit>
#include <QPointF>

#include <cmath>

namespace handway::test {
namespace {

using gui::SceneItem;
using planning::SceneState;
using Kind = SceneItem::Kind;

class EditingAScene : public EditingTest {};

TEST_F(EditingAScene, SelectsByAClickInTheView) {
  QTest::mouseClick(&window().view(), Qt::LeftButton, {}, seen({0.41, 0.38, 0.15}));
  EXPECT_EQ(editor().selection(), (SceneItem{Kind::kObject, "", "post"}));
  EXPECT_EQ(part<QLineEdit>("object_name").text(), "post");
  auto& tree = *window().findChild<gui::SceneTree*>();
  ASSERT_TRUE(tree.currentItem());
  EXPECT_EQ(tree.currentItem()->text(0), "post");
  QTest::mouseClick(&window().view(), Qt::LeftButton, {}, QPoint(4, 4));
  EXPECT_EQ(editor().selection().kind, Kind::kNone);
  EXPECT_FALSE(tree.currentItem());
}

TEST_F(EditingAScene, SelectsFromWhereTheViewIsNotFromWhereItWasDrawn) {
  QWidget& view = window().view();
  const QPoint corner(4, 4);
  QTest::mousePress(&view, Qt::LeftButton, {}, corner);
  move_pressed_mouse(view, corner + QPoint(60, 20));
  QTest::mouseRelease(&view, Qt::LeftButton, {}, corner + QPoint(60, 20));
  QTest::mouseClick(&view, Qt::LeftButton, {}, seen({0.41, 0.38, 0.15}));
  EXPECT_EQ(editor().selection(), (SceneItem{Kind::kObject, "", "post"}));
}

TEST_F(EditingAScene, TakesTypedValuesWithUnits) {
  select("post");
  type("position_x", "0.5 m");
  type("position_y", "12.5");
  type("yaw", "0.5 rad");
  type("size_z", "3 cm");
  EXPECT_DOUBLE_EQ(object("post").X_PO.translation().x(), 0.5);
  EXPECT_DOUBLE_EQ(object("post").X_PO.translation().y(), 0.0125);
  EXPECT_NEAR(geometric::rpy_from_rotation(object("post").X_PO.linear()).z(), 0.5, 1e-8);
  EXPECT_DOUBLE_EQ(std::get<geometric::Box>(object("post").shape).size.z(), 0.03);
  EXPECT_EQ(editor().undo_stack().undoText(), "Resize post");
}

TEST_F(EditingAScene, UndoesEverythingBackToTheSceneItself) {
  const planning::SceneState before = editor().state();
  editor().add("box", geometric::Box{}, {}, {0.6, 0.0, 0.0});
  editor().add("box", geometric::Sphere{}, {}, {0.0, 0.6, 0.0});
  EXPECT_TRUE(geometric::find_object(scene(), "box 2"));
  editor().rename("ball");
  editor().duplicate();
  editor().place(geometric::Pose(Eigen::Translation3d(0.3, -0.4, 0.9)));
  editor().drop();
  EXPECT_NEAR(object("ball 2").X_PO.translation().z(), 0.05, 1e-3);
  editor().set_color({0.1F, 0.2F, 0.3F, 1.0F});
  editor().attach("arm", "palm", {"finger_left"});
  editor().detach();
  editor().set_hidden({"ball"}, true);
  editor().set_solid({"ball"}, false);
  editor().set_locked({"ball"}, true);
  editor().set_goal(geometric::Configuration::Constant(4, 0.1));
  select("post");
  editor().remove();
  editor().select({Kind::kRobot, "arm", ""});
  editor().place(geometric::Pose(Eigen::Translation3d(0.0, 0.0, 0.1)));
  const planning::SceneState after = editor().state();
  ASSERT_EQ(editor().undo_stack().count(), 15);
  EXPECT_TRUE(window().isWindowModified());
  while (editor().undo_stack().canUndo()) {
    actions().undo->trigger();
  }
  EXPECT_EQ(editor().state(), before) << "the same scene, not one like it";
  EXPECT_FALSE(window().isWindowModified());
  while (editor().undo_stack().canRedo()) {
    actions().redo->trigger();
  }
  EXPECT_EQ(editor().state(), after);
}

TEST_F(EditingAScene, KeepsAnObjectInPlaceWhileItIsAttached) {
  select("post");
  const geometric::Pose X_WO = *editor().selected_pose();
  auto& fixed_to = part<QComboBox>("fixed_to");
  fixed_to.setCurrentIndex(fixed_to.findText("palm"));
  emit fixed_to.activated(fixed_to.currentIndex());
  ASSERT_TRUE(object("post").attachment);
  EXPECT_EQ(object("post").attachment->link, "palm");
  EXPECT_TRUE(editor().selected_pose()->isApprox(X_WO, 1e-12));
  EXPECT_EQ(editor().undo_stack().undoText(), "Attach post to arm/palm");
}

TEST_F(EditingAScene, MakesARoomOfAnObject) {
  select("post");
  auto& solid = part<QCheckBox>("solid");
  EXPECT_TRUE(solid.isChecked());
  solid.click();
  EXPECT_FALSE(object("post").solid);
  EXPECT_FALSE(solid.isChecked());
  EXPECT_EQ(editor().undo_stack().undoText(), "Make post Hollow");
  actions().undo->trigger();
  EXPECT_TRUE(object("post").solid);
  EXPECT_TRUE(solid.isChecked());
}

TEST_F(EditingAScene, LeavesLockedObjectsAlone) {
  select("post");
  editor().set_locked({"post"}, true);
  const planning::SceneState locked = editor().state();
  editor().place(geometric::Pose::Identity());
  editor().remove();
  EXPECT_EQ(editor().state(), locked);
  EXPECT_FALSE(actions().remove->isEnabled());
  EXPECT_FALSE(window().view().gizmo().is_shown());
}

TEST_F(EditingAScene, DragsWithTheHandles) {
  select("post");
  QTest::qWait(50);
  gui::SceneView& view = window().view();
  const gui::GizmoFrame frame = view.gizmo().frame(view.camera(), view.size());
  const QPoint tip = seen(frame.centre + 0.9 * frame.size * frame.axes.col(2));
  const QPoint farther = seen(frame.centre + 1.9 * frame.size * frame.axes.col(2));
  const geometric::Pose from = object("post").X_PO;
  QTest::mousePress(&view, Qt::LeftButton, {}, tip);
  ASSERT_TRUE(view.gizmo().is_dragging());
  move_pressed_mouse(view, farther);
  EXPECT_EQ(object("post").X_PO.matrix(), from.matrix()) << "only shown until it is let go";
  QTest::mouseRelease(&view, Qt::LeftButton, {}, farther);
  const Eigen::Vector3d moved = object("post").X_PO.translation() - from.translation();
  EXPECT_NEAR(moved.z(), frame.size, 0.05 * frame.size);
  EXPECT_NEAR(moved.head<2>().norm(), 0.0, 1e-9);
  EXPECT_EQ(editor().undo_stack().undoText(), "Move post");
}

TEST_F(EditingAScene, PutsBackWhatIsDraggedOnEscape) {
  select("post");
  QTest::qWait(50);
  gui::SceneView& view = window().view();
  const gui::GizmoFrame frame = view.gizmo().frame(view.camera(), view.size());
  QTest::mousePress(&view, Qt::LeftButton, {},
                    seen(frame.centre + 0.9 * frame.size * frame.axes.col(2)));
  move_pressed_mouse(view, seen(frame.centre + 1.9 * frame.size * frame.axes.col(2)));
  QTest::keyClick(&view, Qt::Key_Escape);
  EXPECT_FALSE(view.gizmo().is_dragging());
  EXPECT_FALSE(editor().undo_stack().canUndo());
}

// Without a start, planning would begin in the configuration of the robot's file, which is not
// shown, and is not in the saved scene.
TEST_F(EditingAScene, ShowsWhereATaskBeginsThatGotItsGoal) {
  open(cell().folder() / "arm.urdf");
  ASSERT_FALSE(scene().start);
  const geometric::Configuration stood = window().document().configuration();
  const Eigen::Vector4d goal(0.4, 0.9, 0.0, 0.0);
  window().document().set_configuration(goal);
  editor().set_goal(goal);
  EXPECT_EQ(scene().start, stood);
  EXPECT_EQ(scene().goal, geometric::Configuration(goal));
  actions().undo->trigger();
  EXPECT_FALSE(scene().start);
}

TEST_F(EditingAScene, PlansInTheSceneAsItIsNow) {
  select("post");
  editor().remove();
  window().workbench().plan_settings.set_parameter("objective", "shortest");
  plan();
  EXPECT_EQ(window().player().timeline().path().waypoints.size(), 2U) << "straight";
}

TEST_F(EditingAScene, SavesWhatWasEdited) {
  select("post");
  editor().rename("pole");
  type("position_x", "333");
  actions().duplicate->trigger();
  window().document().save(cell().folder() / "edited.yaml", {});
  const geometric::Scene read = geometric::read_scene(cell().folder() / "edited.yaml");
  ASSERT_EQ(read.objects.size(), 2U);
  EXPECT_EQ(read.objects[0].name, "pole");
  EXPECT_DOUBLE_EQ(read.objects[0].X_PO.translation().x(), 0.333);
  EXPECT_EQ(read.objects[1].name, "pole 2");
}

TEST_F(EditingAScene, KeepsPairsThatAreNotCheckedToObjectsThatAreThere) {
  planning::SceneState state = editor().state();
  geometric::Scene with_pair = *state.scene;
  with_pair.allowed_collisions[{"palm", "post"}] = true;
  state.scene = std::make_shared<const geometric::Scene>(std::move(with_pair));
  state = planning::with_renamed_object(state, "post", "a pole");
  EXPECT_EQ(state.scene->allowed_collisions,
            (std::map<geometric::AllowedCollisions::Pair, bool>{{{"a pole", "palm"}, true}}));
  EXPECT_TRUE(planning::without_objects(state, {"a pole"}).scene->allowed_collisions.empty());
}

}  // namespace
}  // namespace handway::test
