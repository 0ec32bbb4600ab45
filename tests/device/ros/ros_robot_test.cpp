/// The client of rosbridge, on an emulated robot, through real WebSockets.
#include "handway/device/ros/ros_robot.h"

#include "handway/device/arm/val3_arm.h"
#include "handway/device/core/device_error.h"
#include "handway/device/emulators/ros_emulator.h"
#include "support/motions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace handway::device {
namespace {

using testing::AllOf;
using testing::HasSubstr;

RosControllerSettings tx90_robot_at_zero() {
  RosControllerSettings settings;
  settings.joints = tx90_joints();
  settings.position = Eigen::VectorXd::Zero(6);
  return settings;
}

std::unique_ptr<RosRobot> robot_at(const std::string& name,
                                   const JointRanges& joints = tx90_joints(),
                                   RosVersion version = RosVersion::kRos1) {
  RosAddress address;
  address.host = "localhost";
  address.port = static_cast<std::uint16_t>(std::stoi(name.substr(name.rfind(':') + 1)));
  address.version = version;
  address.trajectory_topic = trajectory_topic("/arm_controller", version);
  return std::make_unique<RosRobot>(name, address, joints);
}

Eigen::VectorXd way() { return Eigen::VectorXd::LinSpaced(6, 0.1, 0.6); }

JointTrajectory a_second() { return test::swing(Eigen::VectorXd::Zero(6), way(), 1.0); }

/// A robot that is connected and knows its motion.
struct Cell {
  explicit Cell(const RosControllerSettings& settings = tx90_robot_at_zero(),
                RosVersion version = RosVersion::kRos1)
      : emulator(settings, 0), robot(robot_at(emulator.address(), tx90_joints(), version)) {
    robot->connect();
    robot->upload(a_second());
  }

  /// Returns the distance of the robot from its planned straight motion.
  [[nodiscard]] double off_path() const {
    const Eigen::VectorXd at = emulator.position();
    return (at - way() * at.dot(way()) / way().squaredNorm()).norm();
  }

  RosEmulator emulator;
  std::unique_ptr<RosRobot> robot;
};

TEST(RosRobot, TellsWhereTheRobotStands) {
  RosControllerSettings settings = tx90_robot_at_zero();
  settings.position = way();
  const RosEmulator emulator(settings, 0);
  const auto robot = robot_at(emulator.address());
  robot->connect();
  EXPECT_EQ(robot->measured().position, way());
  EXPECT_EQ(robot->phase(), MotionPhase::kIdle);
}

TEST(RosRobot, RunsAMotionInItsTime) {
  for (const RosVersion version : {RosVersion::kRos1, RosVersion::kRos2}) {
    Cell cell(tx90_robot_at_zero(), version);
    MotionTolerances tolerances;
    tolerances.following = 0.1;
    cell.robot->start(tolerances);
    test::run_to_end(*cell.robot);
    EXPECT_EQ(cell.robot->phase(), MotionPhase::kDone) << cell.robot->fault();
    EXPECT_LT((cell.emulator.position() - way()).norm(), 0.01);
  }
}

TEST(RosRobot, HoldsAndGoesOn) {
  Cell cell;
  cell.robot->start();
  test::update_until(*cell.robot, [&] { return cell.emulator.position()[5] > 0.1; });
  const double hold = cell.robot->pause();
  EXPECT_GT(hold, 0.0);
  EXPECT_LT(hold, 1.0);
  test::update_until(
      *cell.robot, [] { return false; }, 0.5);
  EXPECT_FALSE(cell.emulator.moving());
  EXPECT_LT((cell.emulator.position() - cell.robot->trajectory().at(hold)).norm(), 0.05);
  EXPECT_LT(cell.off_path(), 1e-3);
  cell.robot->resume();
  test::run_to_end(*cell.robot);
  EXPECT_EQ(cell.robot->phase(), MotionPhase::kDone) << cell.robot->fault();
}

TEST(RosRobot, StopsTheRobotOnItsPath) {
  Cell cell;
  cell.robot->start();
  test::update_until(*cell.robot, [&] { return cell.emulator.position()[5] > 0.1; });
  cell.robot->stop();
  EXPECT_EQ(cell.robot->phase(), MotionPhase::kStopped);
  EXPECT_LT(test::wait_until([&] { return !cell.emulator.moving(); }), 0.5);
  EXPECT_LT(cell.emulator.position()[5], 0.5);
  EXPECT_LT(cell.off_path(), 1e-3);
}

TEST(RosRobot, LeavesTheRobotStandingOnItsPathWhenTheHostIsGone) {
  Cell cell;
  cell.robot->start();
  test::update_until(*cell.robot, [&] { return cell.emulator.position()[5] > 0.05; });
  cell.robot.reset();
  EXPECT_LT(test::wait_until([&] { return !cell.emulator.moving(); }), 1.0)
      << "it has 0.45 s of the motion at most";
  EXPECT_LT(cell.emulator.position()[5], 0.55);
  EXPECT_LT(cell.off_path(), 1e-3);
}

TEST(RosRobot, RefusesAMotionThatBeginsElsewhere) {
  RosControllerSettings settings = tx90_robot_at_zero();
  settings.position[1] = 0.2;
  Cell cell(settings);
  try {
    cell.robot->start();
    FAIL() << "it started";
  } catch (const DeviceError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("joint_2"), HasSubstr("0.2000")));
  }
  EXPECT_FALSE(cell.emulator.moving());
}

TEST(RosRobot, NamesTheJointThatNobodyTellsOf) {
  const RosEmulator emulator(tx90_robot_at_zero(), 0);
  JointRanges joints = tx90_joints();
  joints.names[3] = "elbow_roll";
  try {
    robot_at(emulator.address(), joints)->connect();
    FAIL() << "it connected";
  } catch (const DeviceError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("elbow_roll"), HasSubstr("/joint_states")));
  }
}

TEST(RosRobot, SaysThatNobodyAnswers) {
  EXPECT_THROW(robot_at("ros://localhost:1")->connect(), DeviceError);
}

struct FaultCase {
  FaultKind kind;
  const char* name;
  const char* message;
};

class FaultyRosRobot : public testing::TestWithParam<FaultCase> {};

TEST_P(FaultyRosRobot, EndsTheMotionWithAMessage) {
  RosControllerSettings settings = tx90_robot_at_zero();
  settings.fault = {GetParam().kind, 0.4};
  Cell cell(settings);
  MotionTolerances tolerances;
  tolerances.following = 0.1;
  cell.robot->start(tolerances);
  test::run_to_end(*cell.robot);
  EXPECT_EQ(cell.robot->phase(), MotionPhase::kFailed);
  EXPECT_THAT(cell.robot->fault(), HasSubstr(GetParam().message));
  EXPECT_THAT(cell.robot->fault(), HasSubstr("ros://localhost"));
  EXPECT_LT(test::wait_until([&] { return !cell.emulator.moving(); }), 1.0);
  EXPECT_GT((cell.emulator.position() - way()).norm(), 0.05) << "stopped under way";
  EXPECT_LT(cell.off_path(), 1e-2);
}

INSTANTIATE_TEST_SUITE_P(Faults, FaultyRosRobot,
                         testing::Values(FaultCase{FaultKind::kLate, "Late", "no joint positions"},
                                         FaultCase{FaultKind::kLost, "Lost", "connection broke"},
                                         FaultCase{FaultKind::kRefused, "Refused",
                                                   "the controller is not running"},
                                         FaultCase{FaultKind::kEstop, "Estop", "emergency stop"},
                                         FaultCase{FaultKind::kJointLimit, "JointLimit", "error 2"},
                                         FaultCase{FaultKind::kSlow, "Slow", "does not follow"}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace handway::device
