/// The messages of rosbridge.
#include "handway/device/ros/rosbridge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace handway::device {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

RosTrajectory two_points() {
  RosTrajectory trajectory{{"a", "b"}, {{0.25, 1.000000001}, Eigen::MatrixXd(2, 2)}};
  trajectory.motion.positions << 0.1, -1.0 / 3.0, 0.2, 0.5;
  return trajectory;
}

TEST(Rosbridge, ReadsBackTrajectoriesToTheBit) {
  for (const RosVersion version : {RosVersion::kRos1, RosVersion::kRos2}) {
    const RosbridgeMessage message = parse_rosbridge(publish("/go", two_points(), version));
    EXPECT_EQ(message.op, "publish");
    EXPECT_EQ(message.topic, "/go");
    ASSERT_TRUE(message.trajectory);
    EXPECT_THAT(message.trajectory->names, ElementsAre("a", "b"));
    EXPECT_EQ(message.trajectory->motion.positions, two_points().motion.positions);
    EXPECT_THAT(message.trajectory->motion.times,
                ElementsAre(0.25, testing::DoubleNear(1.000000001, 1e-12)));
  }
}

TEST(Rosbridge, NamesDurationsAndTypesAsTheVersionDoes) {
  EXPECT_THAT(publish("/go", two_points(), RosVersion::kRos1),
              HasSubstr(R"("time_from_start":{"nsecs":250000000,"secs":0})"));
  EXPECT_THAT(publish("/go", two_points(), RosVersion::kRos2),
              HasSubstr(R"("time_from_start":{"nanosec":250000000,"sec":0})"));
  EXPECT_EQ(ros_type("sensor_msgs", "JointState", RosVersion::kRos1), "sensor_msgs/JointState");
  EXPECT_EQ(ros_type("sensor_msgs", "JointState", RosVersion::kRos2), "sensor_msgs/msg/JointState");
}

TEST(Rosbridge, ReadsWhatARobotTells) {
  const RosbridgeMessage joints = parse_rosbridge(
      R"({"op":"publish","topic":"/joint_states","msg":{"header":{"seq":7,"stamp":{"secs":1,
          "nsecs":2},"frame_id":""},"name":["x","y"],"position":[0.5,null],"velocity":[],
          "effort":[]}})");
  ASSERT_TRUE(joints.joint_state);
  EXPECT_THAT(joints.joint_state->names, ElementsAre("x", "y"));
  EXPECT_EQ(joints.joint_state->position[0], 0.5);
  EXPECT_TRUE(std::isnan(joints.joint_state->position[1])) << "rosbridge makes NaN null";

  RobotStatus status{1, 0, 3, 1, 0, 2, 0};
  EXPECT_EQ(parse_rosbridge(publish("/robot_status", status)).robot_status, status);

  const RosbridgeMessage error =
      parse_rosbridge(R"({"op":"status","level":"error","msg":"no","id":"i"})");
  EXPECT_EQ(error.level, "error");
  EXPECT_EQ(error.text, "no");
  EXPECT_EQ(error.id, "i");
}

TEST(Rosbridge, AsksForTopics) {
  const RosbridgeMessage message = parse_rosbridge(subscribe("1", "/joint_states", "t/T"));
  EXPECT_EQ(message.op, "subscribe");
  EXPECT_EQ(message.id, "1");
  EXPECT_EQ(message.type, "t/T");
  EXPECT_EQ(parse_rosbridge(advertise("/go", "t/T")).op, "advertise");
}

// 20,000 names and as many points in 100 kB would be a matrix of 3.2 GB if they were believed.
TEST(Rosbridge, BelievesNoNumberOfPointsBeforeItHasReadThem) {
  std::string names;
  std::string points;
  for (int k = 0; k < 20'000; ++k) {
    names += R"("",)";
    points += "1,";
  }
  const std::string text = R"({"op":"publish","topic":"/go","msg":{"joint_names":[)" + names +
                           R"(""],"points":[)" + points + "1]}}";
  EXPECT_THROW(static_cast<void>(parse_rosbridge(text)), RosbridgeError);
}

TEST(Rosbridge, RefusesStatesThatAreNoSmallWholeNumbers) {
  for (const char* number :
       {"1e300", "0.5", "4294967296", "18446744073709551615", "true", "null"}) {
    const std::string text = std::string(R"({"op":"publish","topic":"/robot_status","msg":{)") +
                             R"("mode":{"val":1},"e_stopped":{"val":)" + number +
                             R"(},"drives_powered":{"val":1},"motion_possible":{"val":1},)" +
                             R"("in_motion":{"val":0},"in_error":{"val":0},"error_code":0}})";
    EXPECT_THROW(static_cast<void>(parse_rosbridge(text)), RosbridgeError) << number;
  }
}

TEST(Rosbridge, RefusesWhatIsNone) {
  for (const char* text :
       {"", "{", "[]", "{}", R"({"op":5})", R"({"op":"publish"})", R"({"op":"status"})",
        R"({"op":"publish","msg":{"name":["a"],"position":[]}})",
        R"({"op":"publish","msg":{"name":["a"],"position":["x"]}})",
        R"({"op":"publish","msg":{"joint_names":["a"],"points":[{"positions":[1]}]}})",
        R"({"op":"publish","msg":{"joint_names":["a"],"points":[{"positions":[],
            "time_from_start":{"secs":0,"nsecs":0}}]}})",
        R"({"op":"publish","msg":{"e_stopped":1}})"}) {
    EXPECT_THROW(static_cast<void>(parse_rosbridge(text)), RosbridgeError) << text;
  }
}

}  // namespace
}  // namespace handway::device
