#include "handway/planning/timing/kinematic_limits.h"

#include "handway/planning/core/objective.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"
#include "handway_test/solid_robots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

using geometric::RobotModel;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class JointLimitsFile : public testing::Test {
 protected:
  [[nodiscard]] JointKinematicLimits read(const std::string& text) const {
    std::ofstream(folder_.path() / "limits.yaml") << text;
    return read_joint_kinematic_limits(model_, folder_.path() / "limits.yaml");
  }
  [[nodiscard]] std::string refusal(const std::string& text) const {
    return test::refusal_of([&] { static_cast<void>(read(text)); });
  }
  [[nodiscard]] int variable(const char* name) const { return model_.find_variable(name).value(); }

  test::ScratchFolder folder_;
  RobotModel model_{test::planar_hand_arm()};
};

TEST(JointKinematicLimits, HaveDefaultsWhereTheRobotHasNone) {
  const RobotModel model(test::planar_hand_arm());
  const JointKinematicLimits limits = rate_limits(model);
  EXPECT_EQ(limits.velocity, Eigen::VectorXd::Constant(5, kDefaultVelocity));
  EXPECT_EQ(limits.acceleration, Eigen::VectorXd::Constant(5, kDefaultVelocity / kDefaultRampTime));
}

TEST(JointKinematicLimits, KeepThoseOfCoupledJointsToo) {
  geometric::RobotDescription robot = test::planar_hand_arm();
  for (geometric::Joint& joint : robot.joints) {
    joint.limits.velocity = joint.mimic ? 0.4 : 2.0;  // a tip turns by half its finger's angle
    joint.limits.acceleration = joint.mimic ? 3.0 : 5.0;
  }
  const RobotModel model(robot);
  const JointKinematicLimits limits = rate_limits(model);
  const int left = model.find_variable("left").value();
  const int shoulder = model.find_variable("shoulder").value();
  EXPECT_DOUBLE_EQ(limits.velocity[left], 0.8);
  EXPECT_DOUBLE_EQ(limits.acceleration[left], 5.0);
  EXPECT_DOUBLE_EQ(limits.velocity[shoulder], 2.0);
}

TEST_F(JointLimitsFile, ReplacesWhatItNames) {
  const JointKinematicLimits limits = read(
      "joint_limits:\n"
      "  shoulder:\n    has_velocity_limits: true\n    max_velocity: 3\n"
      "    has_acceleration_limits: true\n    max_acceleration: 7\n    max_jerk: 50\n"
      "  elbow:\n    has_velocity_limits: false\n    max_velocity: 3\n"
      "  left_tip:\n    max_velocity: 0.1\n");
  EXPECT_EQ(limits.velocity[variable("shoulder")], 3.0);
  EXPECT_EQ(limits.acceleration[variable("shoulder")], 7.0);
  EXPECT_EQ(limits.jerk[variable("shoulder")], 50.0);
  EXPECT_EQ(limits.jerk[variable("elbow")],
            limits.acceleration[variable("elbow")] / kDefaultJerkTime);
  EXPECT_EQ(limits.velocity[variable("elbow")], kDefaultVelocity);
  EXPECT_EQ(limits.velocity[variable("left")], 0.2) << "its tip turns by half";
}

TEST_F(JointLimitsFile, IsRefusedForAJointThatTheRobotHasNot) {
  EXPECT_THAT(refusal("joint_limits:\n  shoulder:\n    max_velocity: 1\n"
                      "  elbwo:\n    max_velocity: 0.1\n"),
              AllOf(HasSubstr("limits.yaml:"), HasSubstr("joint_limits.elbwo"),
                    HasSubstr("The nearest are elbow, ")));
}

// MoveIt's file is about arm, gripper and all, and says more than rates.
TEST_F(JointLimitsFile, MayBeAboutMoreThanTheRobot) {
  const JointKinematicLimits limits = read(
      "default_velocity_scaling_factor: 0.1\njoint_limits:\n"
      "  shoulder:\n    max_velocity: 3\n    angle_wraparound: false\n    max_deceleration: 1\n"
      "    has_effort_limits: true\n    max_effort: 80\n"
      "  shoulder2:\n    max_velocity: 1\n"
      "  gripper_finger:\n    max_velocity: 1\n");
  EXPECT_EQ(limits.velocity[variable("shoulder")], 3.0);
}

using Assumed = std::vector<AssumedLimit>;

Assumed of_rate(const JointKinematicLimits& limits, Rate rate) {
  Assumed some = limits.assumed;
  std::erase_if(some, [rate](const AssumedLimit& one) { return one.rate != rate; });
  return some;
}

TEST_F(JointLimitsFile, MayHaveDegreesAsXacroReadsThem) {
  const JointKinematicLimits limits =
      read("joint_limits: {shoulder: {max_velocity: !degrees 180, max_acceleration: !radians 2}}");
  EXPECT_NEAR(limits.velocity[variable("shoulder")], std::numbers::pi, 1e-12);
  EXPECT_EQ(limits.acceleration[variable("shoulder")], 2.0);
}

TEST_F(JointLimitsFile, MayBeWithinTheParametersOfANode) {
  const JointKinematicLimits limits = read(
      "/**: {ros__parameters: {robot_description_planning: {joint_limits: {shoulder: "
      "{max_velocity: 3}}}}}");
  EXPECT_EQ(limits.velocity[variable("shoulder")], 3.0);
}

TEST(JointKinematicLimits, SayWhichWereAssumed) {
  geometric::RobotDescription robot = test::planar_hand_arm();
  for (geometric::Joint& joint : robot.joints) {
    joint.limits.velocity = joint.name == "elbow" ? 0.0 : 2.0;
    joint.limits.acceleration = joint.name == "shoulder" ? 5.0 : 0.0;
  }
  const JointKinematicLimits limits = rate_limits(RobotModel(robot));
  EXPECT_THAT(of_rate(limits, Rate::kVelocity),
              ElementsAre(AssumedLimit{"elbow", Rate::kVelocity, kDefaultVelocity}));
  EXPECT_THAT(of_rate(limits, Rate::kAcceleration), SizeIs(4)) << "of all but the shoulder";
  EXPECT_THAT(of_rate(limits, Rate::kJerk), SizeIs(5));
  EXPECT_THAT(of_rate(limits.without_jerk(), Rate::kJerk), IsEmpty());
  const std::vector<std::string> lines = assumption_lines(limits.assumed, 2);
  ASSERT_THAT(lines, SizeIs(3));
  EXPECT_THAT(lines[0], AllOf(HasSubstr("velocity"), HasSubstr("1 rad/s"), HasSubstr("elbow")));
  EXPECT_THAT(lines[1], AllOf(HasSubstr("acceleration"), HasSubstr("0.25 s"),
                              HasSubstr("elbow, thumb and 2 more")));
}

TEST_F(JointLimitsFile, LeavesNothingAssumedThatItHas) {
  std::string text = "joint_limits:\n";
  for (const char* joint : {"shoulder", "elbow", "thumb", "left", "right"}) {
    text += std::string("  ") + joint +
            ": {max_velocity: 1, max_acceleration: 2, has_jerk_limits: true, max_jerk: 3}\n";
  }
  EXPECT_THAT(read(text).assumed, IsEmpty());
}

TEST_F(JointLimitsFile, IsRefusedWithLineAndKey) {
  EXPECT_THAT(refusal("joint_limits:\n  elbow:\n    max_velocity: 0\n"),
              AllOf(HasSubstr("limits.yaml:3"), HasSubstr("max_velocity"), HasSubstr("above 0")));
  EXPECT_THAT(refusal("joint_limits:\n  elbow:\n    max_velocity: .nan\n"),
              HasSubstr("limits.yaml:3"));
  EXPECT_THAT(refusal("joint_limits:\n  elbow:\n    max_speed: 1\n"), HasSubstr("max_speed"));
  EXPECT_THAT(refusal("joint_limits:\n  elbow:\n    has_velocity_limits: perhaps\n"
                      "    max_velocity: 1\n"),
              HasSubstr("true or false"));
  EXPECT_THAT(refusal("limits: {}\n"), HasSubstr("joint_limits"));
}

TEST_F(JointLimitsFile, NarrowPositions) {
  const JointKinematicLimits limits = read(
      "joint_limits:\n  elbow: {has_position_limits: true, min_position: -0.4, max_position: 0.3}\n"
      "  shoulder: {has_position_limits: false, min_position: -0.1, max_position: 0.1}\n"
      "  left: {max_position: 1.0, has_soft_limits: true, soft_upper_limit: 0.5}\n");
  ASSERT_EQ(limits.lower.size(), 5);
  EXPECT_EQ(limits.lower[variable("elbow")], -0.4);
  EXPECT_EQ(limits.upper[variable("elbow")], 0.3);
  EXPECT_EQ(limits.upper[variable("left")], 0.5);
  EXPECT_TRUE(std::isinf(limits.upper[variable("shoulder")])) << "denied by its flag";
}

TEST_F(JointLimitsFile, NarrowPositionsOfJointsThatFollow) {
  const JointKinematicLimits limits = read(
      "joint_limits:\n  left: {max_position: 0.5}\n  left_tip: {max_position: 0.2}\n"
      "  right_tip: {min_position: 0.1}\n");
  EXPECT_DOUBLE_EQ(limits.upper[variable("left")], 0.4) << "its tip turns by half";
  EXPECT_DOUBLE_EQ(limits.lower[variable("right")], 0.2);
}

// A coupled joint is no misspelling of the one that it follows.
TEST_F(JointLimitsFile, MayNameACoupledJointAlone) {
  geometric::RobotDescription robot = test::planar_hand_arm();
  std::ranges::find(robot.joints, "left_tip", &geometric::Joint::name)->name = "left_2";
  const RobotModel model(std::move(robot));
  std::ofstream(folder_.path() / "limits.yaml") << "joint_limits: {left_2: {max_velocity: 0.1}}\n";
  const JointKinematicLimits limits =
      read_joint_kinematic_limits(model, folder_.path() / "limits.yaml");
  EXPECT_DOUBLE_EQ(limits.velocity[model.find_variable("left").value()], 0.2);
}

TEST_F(JointLimitsFile, TakesFlagsAsPythonWritesThem) {
  const JointKinematicLimits limits = read(
      "joint_limits:\n  elbow: {has_velocity_limits: True, max_velocity: 0.5}\n"
      "  shoulder: {has_velocity_limits: no, max_velocity: 0.1}\n");
  EXPECT_EQ(limits.velocity[variable("elbow")], 0.5);
  EXPECT_EQ(limits.velocity[variable("shoulder")], kDefaultVelocity);
}

TEST_F(JointLimitsFile, CountsBrakingAsAcceleration) {
  const JointKinematicLimits limits =
      read("joint_limits:\n  elbow: {max_acceleration: 4.0, max_deceleration: 2.5}\n");
  EXPECT_EQ(limits.acceleration[variable("elbow")], 2.5);
}

TEST_F(JointLimitsFile, RefusesPositionsThatLeaveNoRange) {
  EXPECT_THAT(refusal("joint_limits:\n  elbow: {min_position: 0.4, max_position: 0.3}\n"),
              AllOf(HasSubstr("limits.yaml:2"), HasSubstr("positions from 0.4 to 0.3")));
}

}  // namespace
}  // namespace handway::planning
