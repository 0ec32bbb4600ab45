#include "features/playback/path_traces.h"

#include "handway/geometric/setup/swept_volume.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "view3d/scene_view.h"
#include "window_test.h"

#include <QAction>

#include <cmath>

namespace handway::test {
namespace {

TEST(SweptVolume, GoesRoundAllPostures) {
  const SmallCell cell;
  const geometric::RobotInstance robot =
      planning::load_scene(cell.post(), {}).scene->robots.front();
  std::vector<geometric::Configuration> postures;
  for (int i = 0; i <= 100; ++i) {
    postures.push_back(robot.model->neutral());
    postures.back()[0] = 0.01 * i;
  }
  constexpr double kCell = 0.01;
  const geometric::TriangleMesh mesh = geometric::swept_volume(robot, postures, kCell, {});
  ASSERT_FALSE(mesh.empty());
  const geometric::Aabb box = geometric::bounding_box(mesh);
  // The arm, stretched out along x, turns by 1 rad about z.
  std::vector<geometric::Pose> X_BL(static_cast<std::size_t>(robot.model->link_count()));
  robot.model->forward_kinematics(postures.front(), X_BL);
  const double reach = (robot.X_WB * X_BL.back()).translation().x();
  EXPECT_GT(box.upper.x(), reach);
  EXPECT_GT(box.upper.y(), std::sin(1.0) * reach);
}

TEST(SweptVolume, IsNothingWhereNothingMoves) {
  const SmallCell cell;
  const geometric::RobotInstance robot =
      planning::load_scene(cell.post(), {}).scene->robots.front();
  EXPECT_TRUE(geometric::swept_volume(robot, {robot.model->neutral()}, 0.01, {}).empty());
}

class Traces : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (!IsSkipped()) {
      open(cell().post());
      plan();
      window().player().pause();
    }
  }
  [[nodiscard]] gui::PathTraces& traces() const { return tool<gui::PathTraces>(); }
  [[nodiscard]] QImage picture() const {
    QTest::qWait(400);
    return window().view().grabFramebuffer();
  }
};

TEST_F(Traces, ShowPosturesOrTheSweptVolume) {
  const QImage plain = picture();
  traces().postures().setChecked(true);
  const QImage postures = picture();
  EXPECT_NE(postures, plain);
  keep_picture("traces_postures");
  traces().volume().setChecked(true);
  EXPECT_FALSE(traces().postures().isChecked());
  ASSERT_TRUE(QTest::qWaitFor([&] { return !traces().is_busy(); }, 8000));
  EXPECT_NE(picture(), postures);
  keep_picture("traces_volume");
}

TEST_F(Traces, ShowTheWaysOfTheFingertips) {
  const QImage plain = picture();
  traces().trails().setChecked(true);
  EXPECT_NE(picture(), plain);
  keep_picture("traces_fingertips");
}

}  // namespace
}  // namespace handway::test
