#pragma once

#include "features/devices/device_session.h"
#include "features/devices/devices_panel.h"
#include "handway/planning/timing/time_path.h"
#include "patience.h"
#include "window_test.h"

#include <QPushButton>

#include <chrono>
#include <optional>

namespace handway::test {

/// A window whose small cell is connected to devices, and slow motions on them.
class MovingRobot : public WindowTest {
 protected:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] gui::MotionDriver& driver() const { return window().workbench().driver; }
  [[nodiscard]] bool waits_for(gui::MotionDriver::State state) const {
    return QTest::qWaitFor([&] { return driver().state() == state; }, kPatienceMs);
  }

  void wait_for_problem() const {
    ASSERT_TRUE(QTest::qWaitFor(
        [&] { return window().document().problem()->if_ready() != nullptr; }, kPatienceMs));
  }

  /// Opens the cell and connects. @param arm and hand "emulator" or an address.
  void connect_to(const QString& arm, const QString& hand) {
    open(cell().post());
    wait_for_problem();
    QObject::connect(&driver(), &gui::MotionDriver::measured, &driver(),
                     [this](const Eigen::VectorXd& q) { measured_ = q; });
    QObject::connect(&driver(), &gui::MotionDriver::progressed, &driver(), [this] { ++reports_; });
    QObject::connect(&driver(), &gui::MotionDriver::ended, &driver(),
                     [this](const execution::MotionOutcome& outcome) { outcome_ = outcome; });
    tool<gui::DevicesPanel>().choose_devices(arm, hand);
    click("devices_connect");
    ASSERT_TRUE(waits_for(gui::MotionDriver::State::kConnected));
    ASSERT_TRUE(QTest::qWaitFor([&] { return measured_.size() > 0; }, kPatienceMs));
  }

  /// Turns the shoulder from its present position, to and fro from motion to motion.
  void begin_motion(double speed) {
    ASSERT_TRUE(waits_for(gui::MotionDriver::State::kConnected));
    geometric::Configuration there = measured_;
    there[0] = measured_[0] < 0.1 ? 0.25 : -0.1;
    planning::TimingOptions options;
    options.speed = speed;
    options.period = 0.02;
    wait_for_problem();
    const auto problem = window().document().problem()->if_ready();
    const auto motion = std::make_shared<const planning::TimedPath>(
        planning::time_path(*problem, {{measured_, there}}, "slow", options));
    ASSERT_TRUE(motion->cleared());
    outcome_.reset();
    reports_ = 0;
    driver().run(motion, window().document().problem(), {});
    ASSERT_TRUE(QTest::qWaitFor([&] { return reports_ > 2; }, kPatienceMs));
  }

  [[nodiscard]] bool moves() const {
    return driver().state() == gui::MotionDriver::State::kRunning;
  }

  /// Waits for the end of a motion that was asked to stop at `asked`.
  void expect_stopped_within_50_ms(Clock::time_point asked) {
    ASSERT_TRUE(QTest::qWaitFor([&] { return outcome_.has_value(); }, kPatienceMs));
    EXPECT_FALSE(outcome_->done);
    EXPECT_EQ(outcome_->fault, "");
    EXPECT_GE(outcome_->at_rest_ms, 0.0);
    const double ms =
        std::chrono::duration<double, std::milli>(outcome_->stop_sent - asked).count();
    EXPECT_GT(ms, 0.0) << "it was stopped before";
    EXPECT_LT(ms, 50.0);
    longest_ms_ = std::max(longest_ms_, ms);
    RecordProperty("longest_ms", std::to_string(longest_ms_));
  }

  std::optional<execution::MotionOutcome> outcome_;

 private:
  Eigen::VectorXd measured_;
  int reports_ = 0;
  double longest_ms_ = 0.0;
};

}  // namespace handway::test
