#include "features/editing/editing_test.h"
#include "pressed_mouse.h"
#include "view3d/scene_view.h"
#include "view3d/view_gizmo.h"

#include <cmath>
#include <random>

namespace handway::test {
namespace {

using gui::OrbitCamera;
using gui::Projection;
using gui::SceneItem;

constexpr QSize kSize(800, 600);

OrbitCamera parallel_camera() {
  OrbitCamera camera;
  camera.set_projection(Projection::kOrthographic);
  camera.set_placement({{0.2, -0.3, 0.5}, 1.7, 0.6, 0.4});
  return camera;
}

TEST(OrthographicCamera, KeepsTheSizeOfWhatIsAtTheTarget) {
  const OrbitCamera parallel = parallel_camera();
  OrbitCamera perspective = parallel;
  perspective.set_projection(Projection::kPerspective);
  const Eigen::Vector3d p_W = parallel.placement().target + 0.2 * parallel.orientation().col(0);
  const QPointF a = place_of(parallel, kSize, p_W), b = place_of(perspective, kSize, p_W);
  EXPECT_NEAR(a.x(), b.x(), 1e-6);
  EXPECT_NEAR(a.y(), b.y(), 1e-6);
}

TEST(OrthographicCamera, ShowsTheSameAtEveryDepth) {
  const OrbitCamera camera = parallel_camera();
  const Eigen::Vector3d p_W(0.1, 0.2, 0.3);
  const QPointF near = place_of(camera, kSize, p_W + 1.5 * camera.orientation().col(2));
  const QPointF far = place_of(camera, kSize, p_W - 1.5 * camera.orientation().col(2));
  EXPECT_NEAR(near.x(), far.x(), 1e-6);
  EXPECT_NEAR(near.y(), far.y(), 1e-6);
}

TEST(OrthographicCamera, LooksAlongRaysThatEndWhereTheyWereAsked) {
  const OrbitCamera camera = parallel_camera();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(-0.5, 0.5);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d p_W(anywhere(random), anywhere(random), anywhere(random));
    const gui::Ray ray = ray_through(camera, kSize, place_of(camera, kSize, p_W));
    const double along = ray.direction.dot(p_W - ray.origin);
    EXPECT_GT(along, 0.0);
    EXPECT_NEAR((ray.origin + along * ray.direction - p_W).norm(), 0.0, 1e-9);
  }
}

TEST(OrthographicCamera, FitsAllPointsTightly) {
  OrbitCamera camera = parallel_camera();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-0.6, 0.6);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 50; ++i) {
    points.emplace_back(anywhere(random), anywhere(random), anywhere(random));
  }
  camera.fit(points, static_cast<double>(kSize.width()) / kSize.height(), 1.0);
  double least = 1e9;
  for (const Eigen::Vector3d& p : points) {
    const QPointF place = place_of(camera, kSize, p);
    least = std::min(
        {least, place.x(), place.y(), kSize.width() - place.x(), kSize.height() - place.y()});
  }
  EXPECT_NEAR(least, 0.0, 1e-6);
}

TEST(OrthographicCamera, KeepsThePointUnderTheCursorWhenItZooms) {
  OrbitCamera camera = parallel_camera();
  const QPointF cursor(610.0, 140.0);
  const gui::Ray before = ray_through(camera, kSize, cursor);
  camera.zoom(0.7, (cursor.x() - 400.0) / 600.0, -(cursor.y() - 300.0) / 600.0);
  const QPointF now = place_of(camera, kSize, before.origin + 10.0 * before.direction);
  EXPECT_NEAR(now.x(), cursor.x(), 1e-6);
  EXPECT_NEAR(now.y(), cursor.y(), 1e-6);
}

class SeenInParallel : public EditingTest {
 protected:
  void SetUp() override {
    EditingTest::SetUp();
    if (!IsSkipped()) {
      part<QAction>("orthographic").trigger();
    }
  }
  void TearDown() override {
    if (!IsSkipped()) {
      window().workbench().preferences.set(gui::PreferenceValues{});
    }
    EditingTest::TearDown();
  }
  [[nodiscard]] gui::SceneView& view() const { return window().view(); }
  [[nodiscard]] QPoint seen(const Eigen::Vector3d& p_W) const {
    return place_of(view().camera(), view().size(), p_W).toPoint();
  }
};

TEST_F(SeenInParallel, SelectsByAClick) {
  EXPECT_EQ(view().camera().projection(), Projection::kOrthographic);
  QTest::mouseClick(&view(), Qt::LeftButton, {}, seen({0.41, 0.38, 0.15}));
  EXPECT_EQ(editor().selection(), (SceneItem{SceneItem::Kind::kObject, "", "post"}));
  QTest::mouseClick(&view(), Qt::LeftButton, {}, QPoint(4, 4));
  EXPECT_EQ(editor().selection().kind, SceneItem::Kind::kNone);
}

TEST_F(SeenInParallel, DragsWithTheHandles) {
  select("post");
  QTest::qWait(50);
  const gui::GizmoFrame frame = view().gizmo().frame(view().camera(), view().size());
  const QPoint tip = seen(frame.centre + 0.9 * frame.size * frame.axes.col(2));
  const QPoint farther = seen(frame.centre + 1.9 * frame.size * frame.axes.col(2));
  const geometric::Pose from = object("post").X_PO;
  QTest::mousePress(&view(), Qt::LeftButton, {}, tip);
  ASSERT_TRUE(view().gizmo().is_dragging());
  move_pressed_mouse(view(), farther);
  QTest::mouseRelease(&view(), Qt::LeftButton, {}, farther);
  const Eigen::Vector3d moved = object("post").X_PO.translation() - from.translation();
  EXPECT_NEAR(moved.z(), frame.size, 0.05 * frame.size);
  EXPECT_NEAR(moved.head<2>().norm(), 0.0, 1e-9);
}

TEST_F(SeenInParallel, DrawsTheSamePictureFastAndFinely) {
  view().set_shadows(false);  // which fast pictures do without
  view().settle();
  static_cast<void>(view().grabFramebuffer());
  geometric::Configuration q = window().document().configuration();
  q[0] += 0.2;
  window().document().set_configuration(q);
  static_cast<void>(view().grabFramebuffer());
  q[0] += 0.2;
  window().document().set_configuration(q);
  const QImage fast = view().grabFramebuffer();
  view().settle();
  const QImage fine = view().grabFramebuffer();
  int differing = 0;
  for (int y = 0; y < fine.height(); ++y) {
    for (int x = 0; x < fine.width(); ++x) {
      const QColor a = fast.pixelColor(x, y), b = fine.pixelColor(x, y);
      differing += std::abs(a.red() - b.red()) > 48 || std::abs(a.blue() - b.blue()) > 48 ? 1 : 0;
    }
  }
  EXPECT_LT(differing, 0.004 * fine.width() * fine.height()) << "edges alone may differ";
}

}  // namespace
}  // namespace handway::test
