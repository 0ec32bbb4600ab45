/// Tests that the robot comes to rest, whatever ends the program or the scene.
#include "features/devices/moving_robot.h"
#include "handway/device/emulators/arm_emulator.h"
#include "handway/device/emulators/hand_emulator.h"
#include "model/devices/motion_driver.h"
#include "model/devices/program_end.h"

#include <QMessageBox>
#include <QProcess>
#include <QTimer>

#include <csignal>
#include <functional>

namespace handway::test {
namespace {

class Leaving : public MovingRobot {
 protected:
  void SetUp() override {
    MovingRobot::SetUp();
    if (!IsSkipped()) {
      connect_to("emulator", "emulator");
      begin_motion(0.05);
    }
  }

  /// Leaves the scene by a function, and answers the question that follows.
  void leave(const std::function<void()>& leave, QMessageBox::StandardButton answer) {
    bool was_asked = false;
    QTimer watch;
    QObject::connect(&watch, &QTimer::timeout, &watch, [&] {
      if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget())) {
        watch.stop();
        was_asked = true;
        EXPECT_TRUE(moves());
        box->button(answer)->click();
      }
    });
    watch.start(5);
    leave();
    EXPECT_TRUE(was_asked);
  }
  /// The motion was stopped, and its rest waited for: before the window's thread went on.
  void expect_at_rest() {
    EXPECT_TRUE(driver().stop_and_wait(std::chrono::milliseconds(0)));
    ASSERT_TRUE(QTest::qWaitFor([&] { return outcome_.has_value(); }, kPatienceMs));
    EXPECT_FALSE(outcome_->done);
    EXPECT_GE(outcome_->at_rest_ms, 0.0);
  }
};

TEST_F(Leaving, AsksAndStopsBeforeTheWindowCloses) {
  leave([this] { window().close(); }, QMessageBox::Yes);
  expect_at_rest();
  EXPECT_FALSE(window().isVisible());
}

TEST_F(Leaving, LetsAPersonStay) {
  leave([this] { window().close(); }, QMessageBox::Cancel);
  EXPECT_TRUE(window().isVisible());
  EXPECT_TRUE(moves());
  driver().stop();
  ASSERT_TRUE(waits_for(gui::MotionDriver::State::kConnected));
}

TEST_F(Leaving, AsksAndStopsBeforeAnotherSceneIsOpened) {
  const std::filesystem::path other = cell().wall();
  leave([&] { window().open(QString::fromStdString(other.string())); }, QMessageBox::Yes);
  expect_at_rest();
  EXPECT_TRUE(waits_for(gui::MotionDriver::State::kOff)) << "the devices are of the other scene";
}

TEST_F(Leaving, AsksBeforeANewSceneIsBegun) {
  leave([this] { window().create("tx90_sah"); }, QMessageBox::Cancel);
  EXPECT_TRUE(moves());
}

TEST_F(Leaving, StopsAndWaitsWhenTheWindowIsTornDown) {
  driver().disconnect_all();
  EXPECT_TRUE(waits_for(gui::MotionDriver::State::kOff));
  expect_at_rest();
}

constexpr double kOnItsWay = 0.02;  // rad

/// Emulated devices here, and the window that moves them in another process.
class EndOfTheProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    HANDWAY_NEED_DISPLAY();
    device::Val3ControllerSettings arm;
    arm.joints = {{"shoulder", "elbow"},
                  Eigen::Vector2d(-0.3, -2.5),
                  Eigen::Vector2d(1.8, 2.5),
                  Eigen::Vector2d(1.0, 1.0)};
    arm.position = Eigen::Vector2d::Zero();
    arm_ = std::make_unique<device::ArmEmulator>(arm, 0);
    device::HandControllerSettings hand;
    hand.joints = {{"left", "right"},
                   Eigen::Vector2d(-0.2, -0.8),
                   Eigen::Vector2d(0.8, 0.2),
                   Eigen::Vector2d(1.0, 1.0)};
    hand.position = Eigen::Vector2d::Zero();
    hand_ = std::make_unique<device::HandEmulator>(hand, 0);
  }

  /// Starts the test below in a process of its own, and waits until its robot moves.
  void move_in_another_process(const QString& display) {
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert("HANDWAY_TEST_ARM", QString::fromStdString(arm_->address()));
    environment.insert("HANDWAY_TEST_HAND", QString::fromStdString(hand_->address()));
    environment.insert("DISPLAY", display);
    program_.setProcessEnvironment(environment);
    program_.setProcessChannelMode(QProcess::ForwardedErrorChannel);
    program_.start(QCoreApplication::applicationFilePath(),
                   {"--gtest_filter=MovingForEver.DISABLED_UntilItIsEnded",
                    "--gtest_also_run_disabled_tests"});
    ASSERT_TRUE(QTest::qWaitFor([&] { return arm_->position()[0] > kOnItsWay; }, kPatienceMs));
    ASSERT_TRUE(arm_->moving());
  }
  void expect_rest() {
    ASSERT_TRUE(program_.waitForFinished(10000));
    EXPECT_TRUE(QTest::qWaitFor([&] { return !arm_->moving() && !hand_->moving(); }, 1500));
    EXPECT_LT(arm_->position()[0], 0.24) << "before the end of its motion";
  }

  std::unique_ptr<device::ArmEmulator> arm_;
  std::unique_ptr<device::HandEmulator> hand_;
  QProcess program_;
};

class MovingForEver : public MovingRobot {};

/// This is not a test of its own: those below run it in another process.
TEST_F(MovingForEver, DISABLED_UntilItIsEnded) {
  connect_to(qEnvironmentVariable("HANDWAY_TEST_ARM"), qEnvironmentVariable("HANDWAY_TEST_HAND"));
  const gui::ProgramEnd end(driver());
  begin_motion(0.05);
  QTest::qWait(kPatienceMs);
}

TEST_F(EndOfTheProgram, ByAKillLeavesItToTheWatchdogs) {
  move_in_another_process(qEnvironmentVariable("DISPLAY"));
  program_.kill();
  expect_rest();
  EXPECT_EQ(arm_->stops(), 0) << "nobody could send one";
  EXPECT_EQ(hand_->stops(), 0);
}

class EndBySignal : public EndOfTheProgram, public testing::WithParamInterface<int> {};

TEST_P(EndBySignal, StopsFirst) {
  move_in_another_process(qEnvironmentVariable("DISPLAY"));
  ::kill(static_cast<pid_t>(program_.processId()), GetParam());
  expect_rest();
  EXPECT_EQ(program_.exitStatus(), QProcess::CrashExit) << "the signal does what it always does";
  EXPECT_GE(arm_->stops(), 1);
  EXPECT_GE(hand_->stops(), 1);
}

INSTANTIATE_TEST_SUITE_P(Signals, EndBySignal, testing::Values(SIGINT, SIGTERM, SIGHUP),
                         [](const auto& test) {
                           return std::string(test.param == SIGINT    ? "Interrupt"
                                              : test.param == SIGTERM ? "Terminate"
                                                                      : "HangUp");
                         });

TEST_F(EndOfTheProgram, ByALostDisplayStopsFirst) {
  QProcess server;
  server.setProcessChannelMode(QProcess::ForwardedErrorChannel);
  server.start("Xvfb", {"-displayfd", "1", "-screen", "0", "1280x800x24", "-nolisten", "tcp"});
  ASSERT_TRUE(server.waitForStarted());
  ASSERT_TRUE(server.waitForReadyRead(20000));
  move_in_another_process(":" + QString::fromLatin1(server.readLine()).trimmed());
  server.kill();
  expect_rest();
  EXPECT_GE(arm_->stops(), 1);
  EXPECT_GE(hand_->stops(), 1);
  EXPECT_TRUE(server.waitForFinished());
}

}  // namespace
}  // namespace handway::test
