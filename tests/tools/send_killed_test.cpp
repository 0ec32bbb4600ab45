/// Tests that a robot comes to rest if the program that moves it is killed or hangs: by the
/// devices' watchdogs.
#include "background_process.h"
#include "command_line.h"
#include "handway/device/emulators/arm_emulator.h"
#include "handway/device/emulators/hand_emulator.h"
#include "handway/device/emulators/ros_emulator.h"
#include "handway/execution/motion/motion_target.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "sent_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <string>
#include <thread>

namespace handway::test {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

// Longest time from the signal to rest: 0.25 s in which the hand receives nothing, or 0.5 s that
// are left of the points sent to a robot in ROS, 0.25 s of brakes, and a busy machine.
constexpr milliseconds kLongestRest{1500};

/// Emulated devices at the scene's start in this process, and `handway send` in another.
class SendThatIs : public testing::TestWithParam<int> {
 protected:
  SendThatIs() {
    const planning::PluginManager plugins;
    const planning::SceneState loaded = planning::load_scene(scene(), plugins);
    problem_ = std::make_unique<planning::PlanningProblem>(
        planning::make_problem(loaded.scene, loaded.basis));
    line_.write("path.csv", planned_path());
  }

  template <typename Settings>
  [[nodiscard]] Settings settings(const std::string& kind) const {
    const geometric::JointIndices variables = problem_->joints.of_part(kind);
    Settings settings;
    settings.joints = execution::device_joints(problem_->model(), variables);
    settings.position = problem_->start(variables);
    return settings;
  }

  /// Sends the path, gives the sender the signal under way, and waits for rest.
  /// @param moving whether any device moves.
  template <typename Moving>
  void expect_rest_after_signal(const std::string& targets, const Moving& moving) {
    const BackgroundProcess sending({"send", (line_.folder() / "path.csv").string(), "--scene",
                                     scene(), "--to", targets, "--speed", "0.1", "--yes"});
    ASSERT_TRUE(comes(moving, milliseconds(20000))) << "it begins";
    std::this_thread::sleep_for(milliseconds(700));
    ASSERT_TRUE(moving());
    sending.send(GetParam());
    const auto begin = Clock::now();
    EXPECT_TRUE(comes([&] { return !moving(); }, kLongestRest));
    RecordProperty(
        "rest_ms",
        static_cast<int>(std::chrono::duration<double, std::milli>(Clock::now() - begin).count()));
    std::this_thread::sleep_for(milliseconds(300));
    EXPECT_FALSE(moving()) << "and stays there";
  }

 private:
  template <typename Condition>
  static bool comes(const Condition& condition, milliseconds longest) {
    const auto end = Clock::now() + longest;
    while (!condition()) {
      if (Clock::now() > end) {
        return false;
      }
      std::this_thread::sleep_for(milliseconds(2));
    }
    return true;
  }

  CommandLine line_;
  std::unique_ptr<planning::PlanningProblem> problem_;
};

TEST_P(SendThatIs, LeavesArmAndHandAtRest) {
  const device::ArmEmulator arm(settings<device::Val3ControllerSettings>("arm"), 0);
  const device::HandEmulator hand(settings<device::HandControllerSettings>("hand"), 0);
  expect_rest_after_signal(arm.address() + "," + hand.address(),
                           [&] { return arm.moving() || hand.moving(); });
}

TEST_P(SendThatIs, LeavesARobotInRosAtRest) {
  const device::RosEmulator robot(settings<device::RosControllerSettings>(execution::kWholeRobot),
                                  0);
  expect_rest_after_signal(robot.address(), [&] { return robot.moving(); });
}

INSTANTIATE_TEST_SUITE_P(Signals, SendThatIs, testing::Values(SIGKILL, SIGSTOP, SIGHUP),
                         [](const auto& test) {
                           return std::string(test.param == SIGKILL   ? "Killed"
                                              : test.param == SIGSTOP ? "Frozen"
                                                                      : "HungUp");
                         });

}  // namespace
}  // namespace handway::test
