#include "view3d/scene_view.h"
#include "window_test.h"

#include <QSlider>

namespace handway::test {
namespace {

class Playback : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (!IsSkipped()) {
      open(cell().post());
      plan();
      window().player().pause();
    }
  }
  [[nodiscard]] const geometric::Configuration& shown() const {
    return window().document().configuration();
  }
  [[nodiscard]] const geometric::Scene& scene() const { return *window().document().scene(); }
};

TEST_F(Playback, MovesTheRobotAlongThePath) {
  window().player().seek(0.0);
  EXPECT_TRUE(shown().isApprox(*scene().start));
  click("play");
  ASSERT_TRUE(QTest::qWaitFor([&] { return window().player().fraction() > 0.1; }));
  EXPECT_FALSE(shown().isApprox(*scene().start));
  click("play");
  EXPECT_FALSE(window().player().is_playing());
}

TEST_F(Playback, ScrubsToTheGoal) {
  auto& scrub = part<QSlider>("scrub");
  scrub.setValue(scrub.maximum());
  EXPECT_TRUE(shown().isApprox(*scene().goal));
}

TEST_F(Playback, StepsFromWaypointToWaypoint) {
  window().player().seek(0.0);
  click("step_forward");
  EXPECT_TRUE(shown().isApprox(window().player().timeline().path().waypoints[1]));
  click("step_back");
  EXPECT_TRUE(shown().isApprox(*scene().start));
}

TEST_F(Playback, BeginsAnewAtTheEndUnlessTheLoopIsOff) {
  click("loop");
  window().player().set_speed(8.0);
  window().player().seek(0.9);
  window().player().play();
  EXPECT_TRUE(QTest::qWaitFor([&] { return !window().player().is_playing(); }));
  EXPECT_EQ(window().player().fraction(), 1.0);
}

}  // namespace
}  // namespace handway::test
