#include "features/editing/editing_test.h"
#include "pressed_mouse.h"
#include "view3d/scene_view.h"
#include "widgets/forms/quantity_field.h"

#include <QAction>

#include <cmath>

namespace handway::test {
namespace {

using gui::SceneItem;
using Kind = SceneItem::Kind;

class MovingThePalm : public EditingTest {
 protected:
  [[nodiscard]] static geometric::Configuration bent() { return Eigen::Vector4d(0.2, 1.3, 0, 0); }
  /// Pulls the selected posture's palm along the world's y axis by the length of an arrow.
  void pull(bool let_go = true) const {
    QTest::qWait(50);
    gui::SceneView& view = window().view();
    const gui::GizmoFrame frame = view.gizmo().frame(view.camera(), view.size());
    const QPoint from = seen(frame.centre + 0.9 * frame.size * frame.axes.col(1));
    const QPoint to = seen(frame.centre + 1.4 * frame.size * frame.axes.col(1));
    QTest::mousePress(&view, Qt::LeftButton, {}, from);
    ASSERT_TRUE(view.gizmo().is_dragging());
    move_pressed_mouse(view, 0.5 * (from + to));
    move_pressed_mouse(view, to);
    if (let_go) {
      QTest::mouseRelease(&view, Qt::LeftButton, {}, to);
    }
  }
  [[nodiscard]] Eigen::Vector3d palm_at(const geometric::Configuration& q) const {
    return geometric::link_pose(scene(), q, "arm", "palm")->translation();
  }
  [[nodiscard]] const geometric::Configuration& shown() const {
    return window().document().configuration();
  }
};

TEST_F(MovingThePalm, TakesTheArmAlong) {
  window().document().set_configuration(bent());
  actions().palm->trigger();
  EXPECT_TRUE(actions().palm->isChecked());
  const geometric::Configuration before = shown();
  pull();
  const Eigen::Vector3d moved = palm_at(shown()) - palm_at(before);
  EXPECT_GT(moved.y(), 0.01);
  EXPECT_NEAR(moved.x(), 0.0, 2e-4);
  EXPECT_EQ(shown().tail(2), before.tail(2)) << "the fingers stay as they are";
  EXPECT_FALSE(editor().undo_stack().canUndo()) << "the scene is the same";
  actions().palm->trigger();
  EXPECT_FALSE(window().view().gizmo().is_shown());
}

TEST_F(MovingThePalm, ComesBackOnEscape) {
  window().document().set_configuration(bent());
  actions().palm->trigger();
  const geometric::Configuration before = shown();
  pull(false);
  EXPECT_NE(shown(), before);
  QTest::keyClick(&window().view(), Qt::Key_Escape);
  EXPECT_EQ(shown(), before);
}

TEST_F(MovingThePalm, MovesTheGoalAndThePathFollows) {
  editor().set_goal(bent());
  plan();
  editor().select({Kind::kGoal, "", ""});
  const geometric::Configuration before = *scene().goal;
  pull();
  EXPECT_GT((palm_at(*scene().goal) - palm_at(before)).norm(), 0.01);
  EXPECT_EQ(editor().undo_stack().undoText(), "Set goal");
  ASSERT_TRUE(QTest::qWaitFor([&] { return !window().session().is_replanning(); }, 8000));
  const planning::Path& path = window().player().timeline().path();
  ASSERT_FALSE(path.waypoints.empty());
  EXPECT_TRUE(path.waypoints.back().isApprox(*scene().goal, 1e-9));
}

TEST_F(MovingThePalm, TakesTypedPlaces) {
  editor().select({Kind::kGoal, "", ""});
  const double y = geometric::millimetres(palm_at(*scene().goal).y());
  auto& field = part<gui::QuantityField>("position_y");
  field.selectAll();
  QTest::keyClicks(&field, QString::number(y - 40.0));
  QTest::keyClick(&field, Qt::Key_Return);
  EXPECT_NEAR(geometric::millimetres(palm_at(*scene().goal).y()), y - 40.0, 0.2);
}

TEST_F(MovingThePalm, TurnsARealHandInPlace) {
  open(source_dir() / "scenes" / "can_on_table.yaml");
  actions().palm->trigger();
  const geometric::Configuration before = shown();
  const geometric::Pose X_WP = *editor().selected_pose();
  const geometric::Pose lifted = Eigen::Translation3d(-0.05, 0.0, 0.1) * X_WP *
                                 Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ());
  editor().place(lifted);
  EXPECT_TRUE(editor().selected_pose()->isApprox(lifted, 1e-9));
  EXPECT_LT((shown() - before).cwiseAbs().maxCoeff(), 1.0) << "on the branch where it was";
  keep_picture("moving_the_palm");
}

TEST_F(MovingThePalm, SelectsAGhostByAClick) {
  const Eigen::Vector3d p = palm_at(*scene().goal);
  QTest::mouseClick(&window().view(), Qt::LeftButton, {}, seen(p + Eigen::Vector3d(0, 0.02, 0.02)));
  EXPECT_EQ(editor().selection().kind, Kind::kGoal);
}

TEST_F(MovingThePalm, SaysThatATypedPoseIsOutOfReachAndLeavesTheGoal) {
  editor().set_goal(bent());
  editor().select({Kind::kGoal, "", ""});
  const geometric::Configuration before = *scene().goal;
  const std::string x = part<gui::QuantityField>("position_x").text().toStdString();
  type("position_x", "5000");
  EXPECT_EQ(*scene().goal, before);
  EXPECT_EQ(part<gui::QuantityField>("position_x").text().toStdString(), x);
  EXPECT_THAT(window().message().toStdString(), ::testing::HasSubstr("gets no nearer than"));
  type("position_x", "350");
  EXPECT_NEAR(palm_at(*scene().goal).x(), 0.35, 1e-4);
}

}  // namespace
}  // namespace handway::test
