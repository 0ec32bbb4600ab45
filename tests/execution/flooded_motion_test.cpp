/// An arm and a hand that move together, one of which begins to send without pause: the stop
/// reaches both all the same.
#include "handway/device/arm/simple_message.h"
#include "handway/device/arm/val3_arm.h"
#include "handway/device/emulators/arm_emulator.h"
#include "handway/device/emulators/hand_emulator.h"
#include "handway/device/hand/hand_protocol.h"
#include "handway/device/hand/network_hand.h"
#include "handway/execution/motion/motion_run.h"
#include "handway_test/flooding_proxy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <thread>

namespace handway::execution {
namespace {

using Clock = std::chrono::steady_clock;
using testing::IsEmpty;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Returns a motion from `start` by `way` at a constant speed within two seconds.
device::JointTrajectory line(const Eigen::VectorXd& start, const Eigen::VectorXd& way) {
  constexpr Eigen::Index kSteps = 100;
  device::JointTrajectory line;
  line.positions.resize(kSteps + 1, start.size());
  for (Eigen::Index i = 0; i <= kSteps; ++i) {
    line.times.push_back(0.02 * static_cast<double>(i));
    line.positions.row(i) = start + static_cast<double>(i) / kSteps * way;
  }
  return line;
}

class Watcher final : public MotionObserver {
 public:
  std::function<void(double time)> progress = [](double) {};

  void on_sample(const MotionSample& /*sample*/) override {}
  void on_progress(double time, const std::vector<FollowingError>& /*errors*/) override {
    progress(time);
  }
};

class FloodedMotion : public testing::Test {
 protected:
  void SetUp() override {
    arm_settings_.joints = device::tx90_joints();
    arm_settings_.position = Eigen::VectorXd::Zero(6);
    hand_settings_.joints = device::sah_joints();
    hand_settings_.position = hand_settings_.joints.upper.cwiseMin(-0.1);
    arm_ = std::make_unique<device::ArmEmulator>(arm_settings_, 0);
    hand_ = std::make_unique<device::HandEmulator>(hand_settings_, 0);
    arm_proxy_ = std::make_unique<test::FloodingArmProxy>(test::port_of(arm_->address()));
    hand_proxy_ = std::make_unique<test::FloodingProxy>(test::port_of(hand_->address()));
    targets_.push_back({"arm",
                        {0, 1, 2, 3, 4, 5},
                        std::make_unique<device::Val3Arm>(
                            "arm", "localhost", arm_proxy_->motion->port(), arm_settings_.joints)});
    targets_.push_back({"hand",
                        {6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18},
                        std::make_unique<device::NetworkHand>(
                            "hand", "localhost", hand_proxy_->port(), hand_settings_.joints)});
    for (const MotionTarget& target : targets_) {
      target.link->connect();
    }
    targets_[0].link->upload(line(arm_settings_.position, Eigen::VectorXd::Constant(6, 0.1)));
    Eigen::VectorXd way = Eigen::VectorXd::Zero(13);
    for (const Eigen::Index j : {2, 5, 8, 11}) {
      way[j] = -0.1;
    }
    targets_[1].link->upload(line(hand_settings_.position, way));
  }

  /// Floods with the present position of the hand, repeated without pause.
  void flood_from_hand() {
    hand_proxy_->flood(device::to_line({0.0, "running", targets_[1].link->measured().position}));
  }
  void flood_from_arm() {
    device::SimpleMessage message;
    const Eigen::VectorXd& position = targets_[0].link->measured().position;
    for (Eigen::Index j = 0; j < position.size(); ++j) {
      message.joints[static_cast<std::size_t>(j)] = static_cast<float>(position[j]);
    }
    const std::vector<std::uint8_t> bytes = encode(message);
    arm_proxy_->state->flood({bytes.begin(), bytes.end()});
  }

  /// Floods after half a second of the motion, and stops a tenth later.
  MotionOutcome run(const std::function<void()>& flood) {
    MotionRequests requests;
    requests.stop = stop_.get_token();
    Watcher watcher;
    bool flooding = false;
    watcher.progress = [&](double time) {
      if (time > 0.5 && !flooding) {
        EXPECT_TRUE(arm_->moving() && hand_->moving());
        flooding = true;
        flood();
      }
      if (time > 0.6 && !stop_.stop_requested()) {
        requested_ = Clock::now();
        stop_.request_stop();
      }
    };
    return run_motion(targets_, {}, requests, watcher);
  }

  /// Returns the time from the end of the run until both are at rest, s.
  [[nodiscard]] double wait_for_rest() const {
    const auto begin = Clock::now();
    while ((arm_->moving() || hand_->moving()) && seconds_since(begin) < 3.0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return seconds_since(begin);
  }

  void expect_stopped(const MotionOutcome& outcome) const {
    EXPECT_FALSE(outcome.done);
    EXPECT_THAT(outcome.fault, IsEmpty());
    EXPECT_LT(outcome.stop_sent_ms, 50.0);
    EXPECT_LT(seconds_since(requested_), 2.0);
    EXPECT_LT(wait_for_rest(), 0.3);
    EXPECT_LT(arm_->position()[0], 0.095);
    EXPECT_GT(hand_->position()[2], hand_settings_.position[2] - 0.095);
  }

  device::Val3ControllerSettings arm_settings_;
  device::HandControllerSettings hand_settings_;
  std::unique_ptr<device::ArmEmulator> arm_;
  std::unique_ptr<device::HandEmulator> hand_;
  std::unique_ptr<test::FloodingArmProxy> arm_proxy_;
  std::unique_ptr<test::FloodingProxy> hand_proxy_;
  std::vector<MotionTarget> targets_;
  std::stop_source stop_;
  Clock::time_point requested_;
};

TEST_F(FloodedMotion, StopsWhileTheHandFloods) {
  expect_stopped(run([this] { flood_from_hand(); }));
  EXPECT_GT(hand_proxy_->flooded(), 1000000U);
}

TEST_F(FloodedMotion, StopsWhileTheArmFloods) {
  expect_stopped(run([this] { flood_from_arm(); }));
  EXPECT_GT(arm_proxy_->state->flooded(), 1000000U);
}

}  // namespace
}  // namespace handway::execution
