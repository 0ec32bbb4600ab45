/// The emulated robot in ROS, without wires.
#include "handway/device/arm/val3_arm.h"
#include "handway/device/emulators/ros_emulator.h"
#include "handway/device/ros/ros_robot.h"
#include "handway/device/ros/rosbridge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace handway::device {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kTopic = "/arm_controller/command";

RosControllerSettings tx90_at_zero() {
  RosControllerSettings settings;
  settings.joints = tx90_joints();
  settings.position = Eigen::VectorXd::Zero(6);
  return settings;
}

/// A robot with a host that has advertised its topic.
struct Talk {
  explicit Talk(const RosControllerSettings& settings = tx90_at_zero()) : robot(settings) {
    EXPECT_THAT(say(advertise(kTopic, "trajectory_msgs/JointTrajectory")), IsEmpty());
  }

  RosController::Messages say(const std::string& text, double now = 0.0) {
    return robot.receive(1, text, now);
  }
  RosController::Messages go(const std::string& joint, double where, double now = 0.0) {
    return say(publish(kTopic, {{joint}, {{0.5}, Eigen::MatrixXd::Constant(1, 1, where)}},
                       RosVersion::kRos1),
               now);
  }

  RosController robot;
};

TEST(RosController, GoesFromWhereItIsAndInsteadOfWhatItDid) {
  Talk talk;
  EXPECT_THAT(talk.go("joint_1", 0.3), IsEmpty());
  talk.robot.advance(0.25);
  EXPECT_NEAR(talk.robot.position()[0], 0.15, 0.02);
  EXPECT_THAT(talk.go("joint_1", 0.0, 0.25), IsEmpty());
  EXPECT_THAT(talk.go("joint_2", 0.2, 0.25), IsEmpty());
  talk.robot.advance(1.0);
  EXPECT_NEAR(talk.robot.position()[0], 0.0, 1e-3);
  EXPECT_NEAR(talk.robot.position()[1], 0.2, 1e-3) << "other joints go on";
}

TEST(RosController, TellsWhatWasSubscribedTo) {
  Talk talk;
  EXPECT_THAT(talk.robot.feedback(1), IsEmpty());
  EXPECT_THAT(talk.say(subscribe("1", kJointStatesTopic, "sensor_msgs/JointState")), IsEmpty());
  EXPECT_THAT(talk.robot.feedback(1), ElementsAre(HasSubstr("joint_6")));
  EXPECT_THAT(talk.say(subscribe("2", kRobotStatusTopic, "industrial_msgs/RobotStatus")),
              IsEmpty());
  EXPECT_THAT(talk.robot.feedback(1), ElementsAre(HasSubstr("joint_6"), HasSubstr("e_stopped")));
  EXPECT_THAT(talk.robot.feedback(2), IsEmpty()) << "another host";
}

TEST(RosController, RefusesTrajectoriesThatItCanNotRun) {
  Talk talk;
  EXPECT_THAT(talk.go("elbow", 0.1), ElementsAre(HasSubstr("elbow")));
  EXPECT_THAT(talk.go("joint_1", 7.0), ElementsAre(HasSubstr("joint_1 would leave its limits")));
  EXPECT_THAT(talk.say("nonsense"), ElementsAre(HasSubstr("error")));
  EXPECT_THAT(talk.say(R"({"op":"dance"})"), ElementsAre(HasSubstr("dance")));
  EXPECT_THAT(talk.say(publish("/other", {{"joint_1"}, {{0.1}, Eigen::MatrixXd::Zero(1, 1)}},
                               RosVersion::kRos2)),
              ElementsAre(HasSubstr("not advertised")));
  talk.robot.advance(1.0);
  EXPECT_EQ(talk.robot.position(), Eigen::VectorXd::Zero(6));
}

TEST(RosController, BrakesForAnEmergencyStop) {
  RosControllerSettings settings = tx90_at_zero();
  settings.fault = {FaultKind::kEstop, 0.2};
  Talk talk(settings);
  EXPECT_THAT(talk.go("joint_1", 0.5), IsEmpty());
  talk.robot.advance(1.0);
  EXPECT_FALSE(talk.robot.moving());
  EXPECT_LT(talk.robot.position()[0], 0.4);
  EXPECT_THAT(talk.say(subscribe("", kRobotStatusTopic, "")), IsEmpty());
  const auto status = parse_rosbridge(talk.robot.feedback(1).at(0)).robot_status;
  ASSERT_TRUE(status);
  EXPECT_EQ(status->emergency_stopped, 1);
  EXPECT_EQ(status->motion_possible, 0);
}

}  // namespace
}  // namespace handway::device
