/// Motions of an arm and a hand together, on emulated ones, through real sockets.
#include "handway/execution/motion/motion_run.h"

#include "fake_device.h"
#include "handway/device/arm/val3_arm.h"
#include "handway/device/emulators/arm_emulator.h"
#include "handway/device/emulators/hand_emulator.h"
#include "handway/device/hand/network_hand.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace handway::execution {
namespace {

using testing::IsEmpty;

std::uint16_t port_of(const std::string& address) {
  return static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1)));
}

class MotionRun : public testing::Test {
 protected:
  void SetUp() override {
    arm_settings_.joints = device::tx90_joints();
    arm_settings_.position = Eigen::VectorXd::Zero(6);
    hand_settings_.joints = device::sah_joints();
    hand_settings_.position = hand_settings_.joints.upper.cwiseMin(-0.1);
  }
  /// Connects both, and gives them a motion each.
  void upload() {
    arm_ = std::make_unique<device::ArmEmulator>(arm_settings_, 0);
    hand_ = std::make_unique<device::HandEmulator>(hand_settings_, 0);
    targets_.push_back({"arm",
                        {0, 1, 2, 3, 4, 5},
                        std::make_unique<device::Val3Arm>(
                            "arm", "localhost", port_of(arm_->address()), arm_settings_.joints)});
    targets_.push_back(
        {"hand",
         {6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18},
         std::make_unique<device::NetworkHand>("hand", "localhost", port_of(hand_->address()),
                                               hand_settings_.joints)});
    for (const MotionTarget& target : targets_) {
      target.link->connect();
    }
    targets_[0].link->upload(line(arm_settings_.position, Eigen::VectorXd::Constant(6, 0.3)));
    Eigen::VectorXd closed = hand_settings_.position;
    for (const Eigen::Index j : {2, 5, 8, 11}) {
      closed[j] -= 0.4;
    }
    targets_[1].link->upload(line(hand_settings_.position, closed));
  }
  MotionOutcome run(Watcher& watcher) {
    requests_.stop = stop_.get_token();
    return run_motion(targets_, {}, requests_, watcher);
  }

  device::Val3ControllerSettings arm_settings_;
  device::HandControllerSettings hand_settings_;
  std::unique_ptr<device::ArmEmulator> arm_;
  std::unique_ptr<device::HandEmulator> hand_;
  std::vector<MotionTarget> targets_;
  std::stop_source stop_;
  MotionRequests requests_;
};

TEST_F(MotionRun, TakesBothToTheEnd) {
  upload();
  Watcher watcher;
  const MotionOutcome outcome = run(watcher);
  EXPECT_TRUE(outcome.done) << outcome.fault;
  EXPECT_TRUE(arm_->position().isApprox(Eigen::VectorXd::Constant(6, 0.3), 0.02));
  ASSERT_EQ(outcome.errors.size(), 2U);
  EXPECT_GT(outcome.errors[0].samples(), 20);
  EXPECT_GT(outcome.errors[1].samples(), 20);
  EXPECT_FALSE(watcher.samples.empty());
}

TEST_F(MotionRun, HoldsBothAtOneTimeAndGoesOn) {
  upload();
  Watcher watcher;
  device::TrajectoryClient& arm = *targets_[0].link;
  device::TrajectoryClient& hand = *targets_[1].link;
  double arm_held = -1.0;
  double hand_held = -1.0;
  int polls = 0;
  watcher.progress = [&](double time) {
    if (!requests_.hold && polls == 0 && time > 0.5) {
      requests_.hold = true;
    } else if (requests_.hold && ++polls > 200) {
      const auto now = device::TrajectoryClient::Clock::now();
      arm_held = arm.motion_time(now);
      hand_held = hand.motion_time(now);
      EXPECT_FALSE(arm_->moving());
      EXPECT_FALSE(hand_->moving());
      requests_.hold = false;
    }
  };
  const MotionOutcome outcome = run(watcher);
  EXPECT_TRUE(outcome.done) << outcome.fault;
  EXPECT_GT(arm_held, 0.5);
  EXPECT_LT(arm_held, 1.4);
  EXPECT_NEAR(arm_held, hand_held, 1e-9);
}

TEST_F(MotionRun, StopsBothWhenAskedTo) {
  upload();
  Watcher watcher;
  watcher.progress = [this](double time) {
    if (time > 0.5) {
      stop_.request_stop();
    }
  };
  const MotionOutcome outcome = run(watcher);
  EXPECT_FALSE(outcome.done);
  EXPECT_THAT(outcome.fault, IsEmpty());
  EXPECT_LT(outcome.time, 1.4);
  EXPECT_LT(arm_->position()[0], 0.28);
  EXPECT_GT(hand_->position()[2], hand_settings_.position[2] - 0.39);
}

TEST_F(MotionRun, StopsTheOtherWhenOneFails) {
  hand_settings_.fault = {device::FaultKind::kEstop, 0.4};
  upload();
  Watcher watcher;
  const MotionOutcome outcome = run(watcher);
  EXPECT_FALSE(outcome.done);
  EXPECT_THAT(outcome.fault, testing::HasSubstr("hand"));
  EXPECT_GE(outcome.at_rest_ms, 0.0);
  EXPECT_LT(arm_->position()[0], 0.28);
}

TEST_F(MotionRun, StartsNothingAfterAStop) {
  upload();
  Watcher watcher;
  stop_.request_stop();
  const MotionOutcome outcome = run(watcher);
  EXPECT_FALSE(outcome.done);
  EXPECT_THAT(outcome.fault, IsEmpty());
  EXPECT_TRUE(arm_->position().isZero(1e-6));
}

TEST_F(MotionRun, StopsBothWhenTheObserverThrows) {
  upload();
  Watcher watcher;
  int calls_after = 0;
  watcher.progress = [&](double time) {
    if (time > 0.5) {
      ++calls_after;
      throw std::runtime_error("the log can't be written");
    }
  };
  const MotionOutcome outcome = run(watcher);
  EXPECT_FALSE(outcome.done);
  EXPECT_EQ(outcome.fault, "the log can't be written");
  EXPECT_EQ(calls_after, 1);
  EXPECT_GE(outcome.at_rest_ms, 0.0) << "it is waited for all the same";
  EXPECT_LT(arm_->position()[0], 0.28);
  // Rest is measured: the controllers' own end of the motion may come some cycles later.
  const auto begin = std::chrono::steady_clock::now();
  while ((arm_->moving() || hand_->moving()) &&
         std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(200)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_FALSE(arm_->moving());
  EXPECT_FALSE(hand_->moving());
}

struct ThrowCase {
  const char* call;
  std::size_t device;
};

class MotionRunWithAnException : public testing::TestWithParam<ThrowCase> {};

TEST_P(MotionRunWithAnException, StopsTheOthersAndReportsIt) {
  std::vector<FakeDevice*> devices;
  std::vector<MotionTarget> targets;
  for (const char* name : {"first", "second"}) {
    auto device = std::make_unique<FakeDevice>(name);
    devices.push_back(device.get());
    device->connect();
    device->upload(line(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1)));
    targets.push_back({name, {}, std::move(device)});
  }
  const std::string call = GetParam().call;
  devices[GetParam().device]->throws_in = call;
  FakeDevice& other = *devices[1 - GetParam().device];
  std::stop_source stop;
  MotionRequests requests{.stop = stop.get_token()};
  Watcher watcher;
  watcher.progress = [&](double time) {
    requests.hold = (call == "pause" || call == "resume") && !requests.hold && time > 0.1;
    if (call == "stop" && time > 0.1) {
      stop.request_stop();
    }
  };
  if (call == "start") {
    EXPECT_THROW((void)run_motion(targets, {}, requests, watcher), std::runtime_error);
  } else {
    const MotionOutcome outcome = run_motion(targets, {}, requests, watcher);
    EXPECT_FALSE(outcome.done);
    EXPECT_EQ(outcome.fault, call + " went wrong");
    EXPECT_LT(outcome.time, 0.5);
  }
  EXPECT_GE(other.stops, 1);
  EXPECT_FALSE(other.moves());
  EXPECT_EQ(call == "stop", devices[GetParam().device]->moves()) << "that one can't be stopped";
}

INSTANTIATE_TEST_SUITE_P(Calls, MotionRunWithAnException,
                         testing::Values(ThrowCase{"start", 0}, ThrowCase{"start", 1},
                                         ThrowCase{"update", 0}, ThrowCase{"update", 1},
                                         ThrowCase{"pause", 0}, ThrowCase{"pause", 1},
                                         ThrowCase{"resume", 0}, ThrowCase{"resume", 1},
                                         ThrowCase{"stop", 0}, ThrowCase{"stop", 1}),
                         [](const auto& test) {
                           return std::string(test.param.call) +
                                  (test.param.device == 0 ? "_of_the_first" : "_of_the_second");
                         });

TEST(MotionRunOfTwo, StopsOneAtOnceThoughTheOtherTakesNoMoreBytes) {
  std::vector<MotionTarget> targets;
  auto stuck = std::make_unique<FakeDevice>("stuck");
  auto free = std::make_unique<FakeDevice>("free");
  stuck->stop_takes = std::chrono::seconds(1);
  const FakeDevice& stopped = *free;
  targets.push_back({"stuck", {}, std::move(stuck)});
  targets.push_back({"free", {}, std::move(free)});
  for (const MotionTarget& target : targets) {
    target.link->connect();
    target.link->upload(line(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1)));
  }
  std::stop_source stop;
  MotionRequests requests{.stop = stop.get_token()};
  device::TrajectoryClient::Clock::time_point requested;
  Watcher watcher;
  watcher.progress = [&](double time) {
    if (time > 0.1 && stop.request_stop()) {
      requested = device::TrajectoryClient::Clock::now();
    }
  };
  const MotionOutcome outcome = run_motion(targets, {}, requests, watcher);
  EXPECT_FALSE(outcome.done);
  EXPECT_LT(stopped.stopped_at - requested, std::chrono::milliseconds(50));
}

}  // namespace
}  // namespace handway::execution
