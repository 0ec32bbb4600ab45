#include "handway/planning/timing/blended_path.h"
#include "handway_test/paths.h"
#include "view3d/scene_view.h"
#include "widgets/panels/log_panel.h"
#include "widgets/panels/playback_bar.h"
#include "window_test.h"

#include <QComboBox>
#include <QLabel>
#include <QShortcut>
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
      ASSERT_TRUE(
          QTest::qWaitFor([&] { return window().workbench().analysis.motion() != nullptr; }, 8000));
      window().player().pause();
    }
  }
  [[nodiscard]] const geometric::Configuration& shown() const {
    return window().document().configuration();
  }
  /// Presses a key of the playback bar, which needs no focus.
  void press(Qt::Key key) const {
    for (QShortcut* shortcut : window().workbench().playback_bar.findChildren<QShortcut*>()) {
      if (shortcut->key() == QKeySequence(key)) {
        emit shortcut->activated();
      }
    }
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

TEST_F(Playback, SaysHowManyPicturesASecondAreDrawn) {
  const auto& rate = part<QLabel>("frame_rate");
  click("play");
  EXPECT_TRUE(QTest::qWaitFor([&] { return rate.text().endsWith("frames/s"); }, 30000));
  click("play");
  EXPECT_TRUE(QTest::qWaitFor([&] { return rate.text().isEmpty(); }, 30000)) << "at rest";
}

TEST_F(Playback, ScrubsToTheGoal) {
  auto& scrub = part<QSlider>("scrub");
  scrub.setValue(scrub.maximum());
  EXPECT_TRUE(shown().isApprox(*scene().goal));
}

TEST_F(Playback, StepsFromWaypointToWaypoint) {
  window().player().seek(0.0);
  press(Qt::Key_BracketRight);
  const geometric::Configuration& waypoint = window().player().timeline().path().waypoints[1];
  EXPECT_NEAR((shown() - waypoint).norm(), 0.0, planning::BlendOptions{}.deviation + 1e-3);
  press(Qt::Key_BracketLeft);
  EXPECT_TRUE(shown().isApprox(*scene().start));
}

TEST_F(Playback, GoesToBothEnds) {
  window().player().seek(0.5);
  click("step_forward");
  EXPECT_TRUE(shown().isApprox(*scene().goal));
  click("step_back");
  EXPECT_TRUE(shown().isApprox(*scene().start));
}

TEST_F(Playback, SlowsTheFirstShortMotionAndSaysSo) {
  open(source_dir() / "scenes" / "can_on_table.yaml");
  plan();
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return window().player().times() == gui::PathPlayer::Times::kKnown; }, 8000));
  ASSERT_LT(window().player().duration(), 3.0);
  auto& speed = part<QComboBox>("speed");
  ASSERT_EQ(speed.currentData().toDouble(), 1.0);
  click("play");
  click("play");
  EXPECT_GE(window().player().duration() / speed.currentData().toDouble(), 3.0);
  EXPECT_TRUE(window().workbench().log.toPlainText().contains("at first, because"));
  speed.setCurrentIndex(speed.findData(1.0));
  click("play");
  click("play");
  EXPECT_EQ(speed.currentData().toDouble(), 1.0) << "only the first one is slowed";
}

TEST_F(Playback, BeginsAnewAtTheEndUnlessTheLoopIsOff) {
  click("loop");
  window().player().set_speed(4.0);
  window().player().seek(0.9);
  window().player().play();
  EXPECT_TRUE(QTest::qWaitFor([&] { return !window().player().is_playing(); }));
  EXPECT_EQ(window().player().fraction(), 1.0);
}

TEST_F(Playback, GoesBackwards) {
  window().player().seek(0.5);
  click("reverse");
  click("play");
  ASSERT_TRUE(QTest::qWaitFor([&] { return window().player().fraction() < 0.4; }));
  click("play");
}

TEST_F(Playback, BackwardsItEndsAtTheStart) {
  click("loop");
  click("reverse");
  window().player().seek(0.1);
  window().player().play();
  EXPECT_TRUE(QTest::qWaitFor([&] { return !window().player().is_playing(); }));
  EXPECT_EQ(window().player().fraction(), 0.0);
}

TEST_F(Playback, StepsByPictures) {
  window().player().seek(0.0);
  click("frame_forward");
  EXPECT_NEAR(window().player().time(), gui::PathPlayer::kFrame, 1e-9);
  click("frame_back");
  EXPECT_EQ(window().player().fraction(), 0.0);
}

TEST_F(Playback, KeepsItsPlaceWhenThePathGetsTimes) {
  gui::PathPlayer& player = window().player();
  const auto motion = player.timeline().motion();
  player.set_motion(nullptr);
  player.step_forward();
  const double waypoint = player.timeline().waypoint_at(player.fraction());
  player.set_motion(motion);
  EXPECT_NEAR(player.timeline().waypoint_at(player.fraction()), waypoint, 1e-9);
}

}  // namespace
}  // namespace handway::test
