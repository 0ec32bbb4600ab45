#include "glove_dock.h"
#include "patience.h"
#include "view3d/scene_view.h"

#include <QCheckBox>
#include <QEventLoop>
#include <QTimer>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <limits>
#include <vector>

namespace handway::test {
namespace {

using Clock = std::chrono::steady_clock;
using device::StreamState;
using ::testing::HasSubstr;

constexpr double kIndexZero = 72.0;  // of the typical calibration
constexpr int kSteps = 60;
constexpr double kAllowed = 50.0;  // ms
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

// A step of the sensors, stamped when the emulated glove reads them, until the
// picture with the new posture is on the screen.
TEST_F(GloveDock, ShowsAPostureWithinFiftyMilliseconds) {
  device::GloveEmulatorSettings settings;
  settings.unit.rate = 100.0;
  struct Step {
    std::atomic<std::uint16_t> counts{80};
    std::atomic<Clock::rep> stamp{0};  // when `counts` was read first
    std::atomic<std::uint16_t> stamped{80};
  };
  auto step = std::make_shared<Step>();
  device::GloveEmulator glove(settings, [step](double) {
    const std::uint16_t counts = step->counts;
    if (step->stamped != counts) {
      step->stamp = Clock::now().time_since_epoch().count();
      step->stamped = counts;
    }
    std::array<std::uint16_t, device::kGloveSensors> all{};
    all.fill(counts);
    return all;
  });
  connect_to(QString::fromStdString(glove.address()));
  ASSERT_TRUE(waits_for(StreamState::kStreaming));
  // An event loop of its own: QTest::qWaitFor() would sleep in between.
  double wanted = 0.0;
  Clock::time_point drawn_at;
  QEventLoop until_drawn;
  QObject::connect(&window().view(), &gui::SceneView::frameSwapped, &until_drawn, [&] {
    if (std::abs(joint("left") - wanted) < 1e-9) {
      drawn_at = Clock::now();
      until_drawn.quit();
    }
  });
  QTimer::singleShot(kPatienceMs, &until_drawn, &QEventLoop::quit);
  // What else the computer does delays everything: the best of three rounds counts.
  double best = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 3 && best > kAllowed; ++round) {
    std::vector<double> delays;
    for (int i = 0; i < kSteps; ++i) {
      const auto counts = static_cast<std::uint16_t>(i % 2 == 0 ? 100 : 80);
      wanted = left_at(counts);
      step->counts = counts;
      until_drawn.exec();
      ASSERT_NEAR(joint("left"), wanted, 1e-9);
      const Clock::time_point read(Clock::duration(step->stamp.load()));
      delays.push_back(std::chrono::duration<double, std::milli>(drawn_at - read).count());
    }
    std::ranges::sort(delays);
    best = std::min(best, delays[kSteps / 2]);
    std::cout << "sensor to pixel: median " << delays[kSteps / 2] << " ms, 95 % "
              << delays[kSteps * 19 / 20] << " ms, worst " << delays.back() << " ms\n";
  }
  RecordProperty("median_ms", std::to_string(best));
  EXPECT_LE(best, kAllowed);
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
