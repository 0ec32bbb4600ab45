#include "features/editing/editing_test.h"
#include "handway/geometric/formats/mesh_reader.h"
#include "handway/geometric/io/resources.h"
#include "handway/planning/edits/resizing.h"
#include "pressed_mouse.h"
#include "view3d/scene_view.h"

#include <QDoubleSpinBox>

namespace handway::test {
namespace {

using geometric::Pose;
using planning::resized;
using planning::ResizeKnob;

const Pose kPlace(Eigen::Translation3d(0.5, 0.2, 0.3));

TEST(Resizing, KeepsTheOppositeSideOfABoxWhereItIs) {
  const auto [shape, X_WO] =
      planning::resized(geometric::Box{{0.1, 0.2, 0.3}}, kPlace, {0, -1}, 0.04, false);
  EXPECT_TRUE(std::get<geometric::Box>(shape).size.isApprox(Eigen::Vector3d(0.14, 0.2, 0.3)));
  EXPECT_TRUE(X_WO.translation().isApprox(Eigen::Vector3d(0.48, 0.2, 0.3)));
}

TEST(Resizing, GrowsRoundThingsAroundTheirAxis) {
  const auto wide = planning::resized(geometric::Cylinder{0.03, 0.12}, kPlace, {1, 1}, 0.01, false);
  EXPECT_NEAR(std::get<geometric::Cylinder>(wide.shape).radius, 0.04, 1e-12);
  EXPECT_EQ(wide.X_WO.matrix(), kPlace.matrix());
  const auto high = planning::resized(geometric::Cone{0.03, 0.12}, kPlace, {2, 1}, 0.02, false);
  EXPECT_NEAR(std::get<geometric::Cone>(high.shape).length, 0.14, 1e-12);
  EXPECT_NEAR(high.X_WO.translation().z(), 0.31, 1e-12);
}

TEST(Resizing, SnapsToWholeCentimetresAndKeepsALeastSize) {
  const geometric::Shape box = geometric::Box{{0.1, 0.2, 0.3}};
  EXPECT_NEAR(
      std::get<geometric::Box>(planning::resized(box, kPlace, {1, 1}, 0.013, true).shape).size.y(),
      0.21, 1e-12);
  EXPECT_NEAR(
      std::get<geometric::Box>(planning::resized(box, kPlace, {1, 1}, -0.9, false).shape).size.y(),
      0.001, 1e-12);
}

TEST(Resizing, ScalesMeshesAllAround) {
  geometric::Mesh mesh;
  mesh.triangles = geometric::tessellate(geometric::Box{{0.1, 0.2, 0.3}});
  const auto [shape, X_WO] = planning::resized(mesh, kPlace, {2, 1}, 0.3, false);
  const geometric::Aabb box = geometric::bounding_box(*std::get<geometric::Mesh>(shape).triangles);
  EXPECT_TRUE(box.size().isApprox(Eigen::Vector3d(0.2, 0.4, 0.6)));
  EXPECT_NEAR(X_WO.translation().z() - 0.3, 0.15, 1e-12) << "it still stands where it stood";
  EXPECT_TRUE(std::get<geometric::Mesh>(shape).scale.isApprox(Eigen::Vector3d::Constant(2.0)));
}

class ResizingByHand : public EditingTest {
 protected:
  [[nodiscard]] gui::ResizeTool& tool() const { return WindowTest::tool<gui::ResizeTool>(); }
  /// Returns the position of the knob at the top of the post.
  [[nodiscard]] QPoint top() const { return tool().places().back(); }
};

TEST_F(ResizingByHand, PullsASide) {
  select("post");
  EXPECT_TRUE(window().view().gizmo().is_shown());
  actions().resize->setChecked(true);
  EXPECT_FALSE(window().view().gizmo().is_shown());
  ASSERT_EQ(tool().places().size(), 6U);
  QTest::qWait(50);
  keep_picture("resize");
  window().resize(900, 640);
  QTest::qWait(50);
  gui::SceneView& view = window().view();
  const QPoint from = top();
  QTest::mousePress(&view, Qt::LeftButton, {}, from);
  ASSERT_TRUE(tool().is_dragging());
  move_pressed_mouse(view, from - QPoint(0, 40));
  EXPECT_FALSE(editor().undo_stack().canUndo()) << "only shown until it is let go";
  QTest::mouseRelease(&view, Qt::LeftButton, {}, from - QPoint(0, 40));
  const double height = std::get<geometric::Box>(object("post").shape).size.z();
  EXPECT_GT(height, 0.42);
  EXPECT_NEAR(object("post").X_PO.translation().z() - height / 2.0, -0.2, 1e-9);
  EXPECT_EQ(editor().undo_stack().undoText(), "Resize post");
  editor().undo_stack().undo();
  EXPECT_EQ(object("post").X_PO.translation().z(), 0.0);
}

TEST_F(ResizingByHand, PutsItBackOnEscape) {
  select("post");
  actions().resize->setChecked(true);
  QTest::qWait(50);
  gui::SceneView& view = window().view();
  const QPoint from = top();
  QTest::mousePress(&view, Qt::LeftButton, {}, from);
  move_pressed_mouse(view, from - QPoint(0, 40));
  QTest::keyClick(&view, Qt::Key_Escape);
  EXPECT_FALSE(tool().is_dragging());
  EXPECT_FALSE(editor().undo_stack().canUndo());
  EXPECT_EQ(top(), from);
}

TEST_F(ResizingByHand, LeavesLockedObjectsAlone) {
  editor().set_locked({"post"}, true);
  select("post");
  actions().resize->setChecked(true);
  EXPECT_TRUE(tool().places().empty());
}

TEST_F(ResizingByHand, TakesTheScaleOfAMesh) {
  geometric::Mesh mesh;
  mesh.file =
      geometric::find_resource(geometric::ResourceKind::kObject, "can", geometric::resource_dir());
  mesh.triangles = geometric::read_mesh(mesh.file);
  editor().add("can", mesh, {}, {0.5, -0.5, 0.0});
  auto& scale = part<QDoubleSpinBox>("size_scale");
  scale.selectAll();
  QTest::keyClicks(&scale, "1.5");
  QTest::keyClick(&scale, Qt::Key_Return);
  EXPECT_TRUE(std::get<geometric::Mesh>(object("can").shape)
                  .scale.isApprox(Eigen::Vector3d::Constant(1.5)));
  EXPECT_EQ(editor().undo_stack().undoText(), "Resize can");
}

}  // namespace
}  // namespace handway::test
