/// The client of the VAL3 server, on an emulated arm, through real sockets.
#include "handway/device/arm/val3_arm.h"

#include "handway/device/core/device_error.h"
#include "handway/device/emulators/arm_emulator.h"
#include "support/motions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace handway::device {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

Val3ControllerSettings tx90_at_zero() {
  Val3ControllerSettings settings;
  settings.joints = tx90_joints();
  settings.position = Eigen::VectorXd::Zero(6);
  return settings;
}

std::unique_ptr<Val3Arm> arm_at(const std::string& address) {
  const auto port = static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1)));
  return std::make_unique<Val3Arm>(address, "localhost", port, tx90_joints());
}

Eigen::VectorXd way() { return Eigen::VectorXd::LinSpaced(6, 0.1, 0.6); }

JointTrajectory a_second() { return test::swing(Eigen::VectorXd::Zero(6), way(), 1.0); }

/// An arm that is connected and knows its motion.
struct Cell {
  explicit Cell(const Val3ControllerSettings& settings = tx90_at_zero(),
                const JointTrajectory& trajectory = a_second())
      : emulator(settings, 0), arm(arm_at(emulator.address())) {
    arm->connect();
    arm->upload(trajectory);
  }

  ArmEmulator emulator;
  std::unique_ptr<Val3Arm> arm;
};

TEST(Val3Arm, TellsWhereTheArmStands) {
  Val3ControllerSettings settings = tx90_at_zero();
  settings.position = way();
  const ArmEmulator emulator(settings, 0);
  const auto arm = arm_at(emulator.address());
  arm->connect();
  EXPECT_TRUE(arm->measured().position.isApprox(way(), 1e-6));
  EXPECT_EQ(arm->phase(), MotionPhase::kIdle);
}

TEST(Val3Arm, RunsAMotionInItsTime) {
  Cell cell;
  cell.arm->start();
  double worst = 0.0;
  std::uint64_t seen = 0;
  EXPECT_TRUE(test::update_until(*cell.arm, [&] {
    const MeasuredJoints& measured = cell.arm->measured();
    if (measured.samples != seen && cell.arm->phase() == MotionPhase::kRunning) {
      seen = measured.samples;
      const double time = cell.arm->motion_time(measured.received);
      worst = std::max(worst,
                       (measured.position - cell.arm->trajectory().at(time)).cwiseAbs().maxCoeff());
    }
    return cell.arm->phase() != MotionPhase::kRunning;
  }));
  EXPECT_EQ(cell.arm->phase(), MotionPhase::kDone) << cell.arm->fault();
  EXPECT_LT((cell.emulator.position() - way()).norm(), 0.01);
  EXPECT_GT(worst, 1e-3) << "a servo lags";
  EXPECT_LT(worst, 0.1);
}

TEST(Val3Arm, WaitsWhereTheMotionWaits) {
  JointTrajectory trajectory = test::swing(Eigen::VectorXd::Zero(6), way(), 0.4);
  const JointTrajectory back = test::swing(way(), -way(), 0.4);
  const auto first = static_cast<Eigen::Index>(trajectory.times.size());
  trajectory.positions.conservativeResize(2 * first, 6);
  trajectory.positions.bottomRows(first) = back.positions;
  for (const double time : back.times) {
    trajectory.times.push_back(time + 0.8);
  }
  Cell cell(tx90_at_zero(), trajectory);
  MotionTolerances tolerances;
  tolerances.following = 0.1;
  cell.arm->start(tolerances);
  test::run_to_end(*cell.arm);
  EXPECT_EQ(cell.arm->phase(), MotionPhase::kDone) << cell.arm->fault();
}

TEST(Val3Arm, RunsOneMotionAfterAnother) {
  Cell cell;
  cell.arm->start();
  test::run_to_end(*cell.arm);
  ASSERT_EQ(cell.arm->phase(), MotionPhase::kDone) << cell.arm->fault();
  cell.arm->upload(test::swing(way(), -way(), 0.3));  // with fewer points
  test::update_until(
      *cell.arm, [] { return false; }, 0.2);
  EXPECT_TRUE(cell.emulator.position().isApprox(way(), 0.02)) << "it waits for its start";
  cell.arm->start();
  test::run_to_end(*cell.arm);
  EXPECT_EQ(cell.arm->phase(), MotionPhase::kDone) << cell.arm->fault();
  EXPECT_LT(cell.emulator.position().norm(), 0.02);
}

TEST(Val3Arm, RunsAShorterMotionWithoutMoves) {
  Cell cell;
  cell.arm->start();
  test::run_to_end(*cell.arm);
  cell.arm->upload(test::swing(way(), Eigen::VectorXd::Zero(6), 0.3));
  cell.arm->start();
  test::run_to_end(*cell.arm);
  EXPECT_EQ(cell.arm->phase(), MotionPhase::kDone) << cell.arm->fault();
}

TEST(Val3Arm, HoldsAndGoesOn) {
  Cell cell;
  cell.arm->start();
  test::update_until(*cell.arm, [&] { return cell.emulator.position()[5] > 0.1; });
  const double hold = cell.arm->pause();
  EXPECT_GT(hold, 0.0);
  EXPECT_LT(hold, 1.0);
  test::update_until(
      *cell.arm, [] { return false; }, 0.4);
  EXPECT_FALSE(cell.emulator.moving());
  EXPECT_TRUE(cell.emulator.position().isApprox(cell.arm->trajectory().at(hold), 0.05));
  cell.arm->resume();
  test::run_to_end(*cell.arm);
  EXPECT_EQ(cell.arm->phase(), MotionPhase::kDone) << cell.arm->fault();
}

TEST(Val3Arm, StopsTheArmAtOnce) {
  Cell cell;
  cell.arm->start();
  test::update_until(*cell.arm, [&] { return cell.emulator.position()[5] > 0.1; });
  ASSERT_TRUE(cell.emulator.moving());
  cell.arm->stop();
  EXPECT_EQ(cell.arm->phase(), MotionPhase::kStopped);
  const double took = test::wait_until([&] { return !cell.emulator.moving(); });
  RecordProperty("stop_ms", std::to_string(1e3 * took));
  EXPECT_LT(took, 0.25) << "0.25 s brake from full speed";
  EXPECT_LT(cell.emulator.position()[5], 0.5);
}

TEST(Val3Arm, RefusesAMotionThatBeginsElsewhere) {
  Val3ControllerSettings settings = tx90_at_zero();
  settings.position[1] = 0.2;
  Cell cell(settings);
  try {
    cell.arm->start();
    FAIL() << "it started";
  } catch (const DeviceError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("joint_2"), HasSubstr("0.2000")));
  }
  EXPECT_FALSE(cell.emulator.moving());
}

TEST(Val3Arm, RefusesAnArmWithoutPowerOrInManualMode) {
  const auto refusal = [](const Val3ControllerSettings& settings) {
    Cell cell(settings);
    try {
      cell.arm->start();
    } catch (const DeviceError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  Val3ControllerSettings settings = tx90_at_zero();
  settings.powered = false;
  EXPECT_THAT(refusal(settings), HasSubstr("power"));
  settings.powered = true;
  settings.automatic = false;
  EXPECT_THAT(refusal(settings), HasSubstr("manual"));
}

TEST(Val3Arm, RefusesMotionsThatAreNone) {
  Cell cell;
  const auto refusal = [&](const JointTrajectory& trajectory) {
    try {
      cell.arm->upload(trajectory);
    } catch (const geometric::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal({}), HasSubstr("0 points"));
  JointTrajectory broken = a_second();
  broken.positions(3, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(broken), AllOf(HasSubstr("point 4"), HasSubstr("joint_3")));
  broken = a_second();
  broken.positions(7, 4) = 3.0;
  EXPECT_THAT(refusal(broken), AllOf(HasSubstr("point 8"), HasSubstr("joint_5")));
  broken = a_second();
  broken.times[5] = broken.times[4];
  EXPECT_THAT(refusal(broken), HasSubstr("point 6"));
  broken = a_second();
  broken.positions.conservativeResize(Eigen::NoChange, 5);
  EXPECT_THAT(refusal(broken), HasSubstr("by 5"));
  EXPECT_THAT(refusal(test::swing(Eigen::VectorXd::Zero(6), way(), 0.05)), HasSubstr("rad/s"));
}

TEST(Val3Arm, SaysThatNobodyAnswers) {
  const auto arm = arm_at("arm://localhost:1");
  EXPECT_THROW(arm->connect(), DeviceError);
}

struct FaultCase {
  FaultKind kind;
  const char* name;
  const char* message;
};

class FaultyArm : public testing::TestWithParam<FaultCase> {};

TEST_P(FaultyArm, EndsTheMotionWithAMessage) {
  Val3ControllerSettings settings = tx90_at_zero();
  settings.fault = {GetParam().kind, 0.4};
  Cell cell(settings);
  MotionTolerances tolerances;
  tolerances.following = 0.1;
  cell.arm->start(tolerances);
  test::run_to_end(*cell.arm);
  EXPECT_EQ(cell.arm->phase(), MotionPhase::kFailed);
  EXPECT_THAT(cell.arm->fault(), HasSubstr(GetParam().message));
  EXPECT_THAT(cell.arm->fault(), HasSubstr("arm://localhost"));
  EXPECT_LT(test::wait_until([&] { return !cell.emulator.moving(); }), 0.5);
  EXPECT_GT((cell.emulator.position() - way()).norm(), 0.05) << "stopped under way";
}

INSTANTIATE_TEST_SUITE_P(Faults, FaultyArm,
                         testing::Values(FaultCase{FaultKind::kLate, "Late", "no joint positions"},
                                         FaultCase{FaultKind::kLost, "Lost", "connection broke"},
                                         FaultCase{FaultKind::kRefused, "Refused", "refused"},
                                         FaultCase{FaultKind::kEstop, "Estop", "emergency stop"},
                                         FaultCase{FaultKind::kJointLimit, "JointLimit", "refused"},
                                         FaultCase{FaultKind::kSlow, "Slow", "does not follow"}),
                         [](const auto& test) { return test.param.name; });

TEST(ArmEmulator, StopsWhenItsHostIsGone) {
  Cell cell;
  cell.arm->start();
  test::update_until(*cell.arm, [&] { return cell.emulator.position()[5] > 0.1; });
  cell.arm.reset();
  EXPECT_LT(test::wait_until([&] { return !cell.emulator.moving(); }), 0.3);
  EXPECT_LT(cell.emulator.position()[5], 0.5);
}

}  // namespace
}  // namespace handway::device
