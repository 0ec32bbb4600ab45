#include "view3d/orientation_cube.h"

#include "pressed_mouse.h"
#include "view3d/scene_view.h"
#include "window_test.h"

#include <QCheckBox>
#include <QSignalSpy>

#include <cmath>
#include <numbers>

namespace handway::test {
namespace {

using gui::CubePart;
using gui::OrbitCamera;
using gui::OrientationCube;

Eigen::Matrix3d seen_from(double azimuth, double elevation) {
  OrbitCamera camera;
  camera.set_placement({Eigen::Vector3d::Zero(), 1.0, azimuth, elevation});
  return camera.orientation();
}

// All 26: faces, edges and corners.
std::vector<CubePart> all_parts() {
  std::vector<CubePart> parts;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x != 0 || y != 0 || z != 0) {
          parts.emplace_back(x, y, z);
        }
      }
    }
  }
  return parts;
}

TEST(CubeParts, AreSeenInTheMiddleFromWhereTheyLook) {
  for (const CubePart& part : all_parts()) {
    SCOPED_TRACE(part.transpose());
    const gui::CubeDirection from = gui::direction_of(part, 0.3);
    const auto seen = gui::cube_part_at(seen_from(from.azimuth, from.elevation), 0.0, 0.0);
    ASSERT_TRUE(seen);
    EXPECT_EQ(*seen, part);
  }
}

TEST(CubeParts, AreNoneBesideTheCube) {
  EXPECT_FALSE(gui::cube_part_at(seen_from(0.0, 0.0), 1.1, 0.0));
  EXPECT_FALSE(gui::cube_part_at(seen_from(0.0, 0.0), 0.0, -1.1));
}

TEST(CubeParts, TurnToTheNearestQuarterFromAbove) {
  const double quarter = 0.5 * std::numbers::pi;
  EXPECT_NEAR(gui::direction_of({0, 0, 1}, 1.3).azimuth, quarter, 1e-12);
  EXPECT_NEAR(gui::direction_of({0, 0, -1}, -0.2).azimuth, 0.0, 1e-12);
  EXPECT_NEAR(gui::direction_of({0, 0, 1}, 1.3).elevation, quarter, 1e-12);
}

class TheOrientationCube : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (!IsSkipped()) {
      open(cell().post());
      static_cast<void>(view().grabFramebuffer());  // after which the cube stands as the view
    }
  }
  void TearDown() override {
    if (!IsSkipped()) {
      window().workbench().preferences.set(gui::PreferenceValues{});
    }
    WindowTest::TearDown();
  }

  [[nodiscard]] gui::SceneView& view() const { return window().view(); }
  [[nodiscard]] OrientationCube& cube() const { return part<OrientationCube>("orientation_cube"); }
  [[nodiscard]] bool looks_along(const CubePart& part) const {
    const Eigen::Vector3d wanted = part.cast<double>().normalized();
    return view().camera().orientation().col(2).dot(wanted) > 1.0 - 1e-5;
  }
  [[nodiscard]] bool wait_until_it_looks_along(const CubePart& part) const {
    return QTest::qWaitFor([&] { return looks_along(part); }, 4000);
  }
  void click(const CubePart& part) const {
    const auto place = cube().place_of(part);
    ASSERT_TRUE(place) << "not seen: " << part.transpose();
    QTest::mouseClick(&cube(), Qt::LeftButton, {}, place->toPoint());
  }
};

TEST_F(TheOrientationCube, TurnsTheViewToAFaceAnEdgeAndACorner) {
  const OrbitCamera::Placement before = view().camera().placement();
  for (const CubePart& part : {CubePart(1, -1, 1), CubePart(1, 0, 1), CubePart(0, 0, 1),
                               CubePart(1, 0, 1), CubePart(1, 0, 0)}) {
    click(part);
    ASSERT_TRUE(wait_until_it_looks_along(part)) << part.transpose();
    static_cast<void>(view().grabFramebuffer());
  }
  EXPECT_EQ(view().camera().placement().target, before.target);
  EXPECT_DOUBLE_EQ(view().camera().placement().distance, before.distance);
}

TEST_F(TheOrientationCube, TurnsWithTheViewAndTheViewWithIt) {
  const double before = view().camera().placement().azimuth;
  const QPoint middle = cube().rect().center();
  QTest::mousePress(&cube(), Qt::LeftButton, {}, middle);
  move_pressed_mouse(cube(), middle + QPoint(30, 0));
  QTest::mouseRelease(&cube(), Qt::LeftButton, {}, middle + QPoint(30, 0));
  EXPECT_LT(view().camera().placement().azimuth, before - 0.3);
  view().look_from(gui::StandardView::kTop);
  ASSERT_TRUE(wait_until_it_looks_along({0, 0, 1}));
  static_cast<void>(view().grabFramebuffer());
  EXPECT_TRUE(cube().place_of({0, 0, 1}));
  EXPECT_FALSE(cube().place_of({0, 0, -1}));
}

TEST_F(TheOrientationCube, LeavesTheSelectionAlone) {
  QSignalSpy picked(&view(), &gui::SceneView::picked);
  click({1, -1, 1});
  EXPECT_TRUE(picked.isEmpty());
}

TEST_F(TheOrientationCube, CanBeHidden) {
  EXPECT_TRUE(cube().isVisible());
  part<QAction>("cube").trigger();
  EXPECT_FALSE(cube().isVisible());
}

TEST_F(TheOrientationCube, DrawsNothingWhileNothingMoves) {
  click({1, -1, 1});
  ASSERT_TRUE(wait_until_it_looks_along({1, -1, 1}));
  const auto is_calm = [this] {  // no two pictures take the same time, to the nanosecond
    const double last = view().frame_time_ms();
    QTest::qWait(500);
    return view().frame_time_ms() == last;
  };
  bool calm = false;  // after the fine picture, and one with the distances there
  for (int attempt = 0; attempt < 10 && !calm; ++attempt) {
    calm = is_calm();
  }
  EXPECT_TRUE(calm);
}

}  // namespace
}  // namespace handway::test
