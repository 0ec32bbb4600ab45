#include "glove_dock.h"
#include "view3d/scene_view.h"

#include <QCheckBox>

#include <algorithm>
#include <vector>

namespace handway::test {
namespace {

using device::StreamState;
using ::testing::HasSubstr;

constexpr double kIndexZero = 72.0;  // of the typical calibration
constexpr double kIndexGain = 0.01616;

double left_at(double counts) { return std::clamp(kIndexGain * (counts - kIndexZero), -0.2, 0.8); }

TEST_F(GloveDock, MovesTheHandWithTheGlove) {
  connect_to_emulator();
  for (const std::uint16_t counts : {80, 100, 90}) {
    set_counts(counts);
    EXPECT_TRUE(QTest::qWaitFor([&] { return std::abs(joint("left") - left_at(counts)) < 1e-9; }))
        << counts;
  }
}

TEST_F(GloveDock, LeavesTheHandAloneWhenItShallNotFollow) {
  connect_to_emulator();
  ASSERT_TRUE(QTest::qWaitFor([&] { return std::abs(joint("left") - left_at(100)) < 1e-9; }));
  part<QCheckBox>("glove_follow").setChecked(false);
  set_counts(80);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return part<gui::SensorBars>("sensor_bars").watch().sensors()[0].counts == 80; }));
  EXPECT_NEAR(joint("left"), left_at(100), 1e-9);
}

TEST_F(GloveDock, MarksJointsAtTheirLimits) {
  connect_to_emulator();
  set_counts(240);
  EXPECT_TRUE(QTest::qWaitFor([&] {
    return part<gui::SensorBars>("sensor_bars").clamped() ==
           std::vector<std::string>{"left", "right"};
  }));
  EXPECT_DOUBLE_EQ(joint("left"), 0.8);
}

TEST_F(GloveDock, SaysWhyItCannotConnect) {
  connect_to(QStringLiteral("/dev/no-such-port"));
  ASSERT_TRUE(waits_for(StreamState::kFailed));
  EXPECT_THAT(part<QLabel>("glove_error").text().toStdString(), HasSubstr("/dev/no-such-port"));
  EXPECT_EQ(part<QAbstractButton>("glove_connect").text(), "Connect");
}

TEST_F(GloveDock, NoticesThatTheCableIsCut) {
  connect_to_emulator();
  unplug();
  ASSERT_TRUE(waits_for(StreamState::kLost));
  EXPECT_FALSE(part<QLabel>("glove_error").text().isEmpty());
  click("glove_connect");
  EXPECT_EQ(panel().session().link().state(), StreamState::kStopped);
}

TEST_F(GloveDock, BringsItsOwnEmulator) {
  connect_to(QStringLiteral("Emulator"));
  ASSERT_TRUE(waits_for(StreamState::kStreaming));
  const double before = joint("left");
  EXPECT_TRUE(QTest::qWaitFor([&] { return std::abs(joint("left") - before) > 0.05; }, 8000));
}

TEST_F(GloveDock, PaintsThePostureThatItShows) {
  connect_to_emulator();
  set_counts(72);
  ASSERT_TRUE(QTest::qWaitFor([&] { return std::abs(joint("left")) < 1e-9; }));
  const QImage closed = window().view().grabFramebuffer();
  set_counts(120);
  ASSERT_TRUE(QTest::qWaitFor([&] { return std::abs(joint("left") - left_at(120)) < 1e-9; }));
  EXPECT_NE(window().view().grabFramebuffer(), closed);
}

}  // namespace
}  // namespace handway::test
