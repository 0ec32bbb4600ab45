#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/limit_violation.h"
#include "handway/geometric/robot/robot_state.h"
#include "handway_test/input_errors.h"
#include "handway_test/robots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <vector>

namespace handway::geometric {
namespace {

using test::turning;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPi = std::numbers::pi;

/// A finger whose "tip" follows its "knuckle" (-1 to 2 rad).
RobotDescription finger(double multiplier, double offset, double lower, double upper) {
  RobotDescription robot;
  robot.name = "finger";
  robot.links = {{"palm", {}, {}}, {"near", {}, {}}, {"far", {}, {}}};
  robot.joints = {turning("knuckle", "palm", "near", -1.0, 2.0),
                  turning("tip", "near", "far", lower, upper)};
  robot.joints.back().mimic = Mimic{"knuckle", multiplier, offset};
  return robot;
}

Configuration bent(double knuckle) { return Configuration::Constant(1, knuckle); }

TEST(CoupledLimits, NarrowTheRangeOfTheJointThatLeads) {
  const RobotModel model(finger(2.0, 0.5, -0.5, 1.5));
  EXPECT_DOUBLE_EQ(model.lower()[0], -0.5);
  EXPECT_DOUBLE_EQ(model.upper()[0], 0.5);
  EXPECT_DOUBLE_EQ(model.variable(0).limits.upper, 0.5) << "what sliders and devices go by";
  EXPECT_THAT(model.description().warnings,
              ElementsAre(AllOf(HasSubstr("knuckle"), HasSubstr("28.65"), HasSubstr("tip"))));
}

// Makers round the limits of what follows.
TEST(CoupledLimits, NarrowItWithoutAWordWhereNobodyWouldNotice) {
  const RobotModel model(finger(2.0, 0.0, -2.0, 3.998));
  EXPECT_DOUBLE_EQ(model.upper()[0], 1.999);
  EXPECT_THAT(model.description().warnings, IsEmpty());
}

TEST(CoupledLimits, NarrowItForAJointThatTurnsTheOtherWay) {
  const RobotModel model(finger(-1.0, 0.0, -0.8, 0.3));
  EXPECT_DOUBLE_EQ(model.lower()[0], -0.3);
  EXPECT_DOUBLE_EQ(model.upper()[0], 0.8);
}

// Files of grippers have limits of followers with the wrong sign.
TEST(CoupledLimits, ArePassedOverWhereTheJointThatLeadsCouldNotMove) {
  RobotDescription robot = finger(-1.0, 0.0, 0.0, 0.9);
  robot.joints.front().limits = {0.0, 0.8};
  const RobotModel model(robot);
  EXPECT_EQ(model.upper()[0], 0.8);
  EXPECT_EQ(model.joint(2).limits.lower, -0.8);
  EXPECT_THAT(limit_violations(model, bent(0.8)), IsEmpty());
  EXPECT_THAT(model.description().warnings,
              ElementsAre(AllOf(HasSubstr("tip"), HasSubstr("knuckle"), HasSubstr("passed over"))));
}

TEST(ContinuousJoints, HaveNoLimitsAndTheRangeOfOneTurn) {
  RobotDescription robot = finger(2.0, 0.5, -kInfinity, kInfinity);
  robot.joints.front().limits = {-kInfinity, kInfinity};
  const RobotModel model(robot);
  EXPECT_TRUE(model.is_continuous(0));
  EXPECT_DOUBLE_EQ(model.upper()[0] - model.lower()[0], 2 * kPi);
  EXPECT_THAT(limit_violations(model, bent(100.0)), IsEmpty());
  EXPECT_EQ(model.clamped(bent(100.0)), bent(100.0));
  EXPECT_THAT(model.description().warnings, IsEmpty());
}

TEST(ContinuousJoints, GoTheShorterWayRound) {
  RobotDescription robot = finger(2.0, 0.5, -kInfinity, kInfinity);
  robot.joints.front().limits = {-kInfinity, kInfinity};
  const RobotModel model(robot);
  EXPECT_DOUBLE_EQ(model.nearest_equivalent(bent(3.1), bent(-3.1))[0], 2 * kPi - 3.1);
  EXPECT_DOUBLE_EQ(model.nearest_equivalent(bent(20.0), bent(0.0))[0], 6 * kPi);
  EXPECT_EQ(model.nearest_equivalent(bent(0.0), bent(kPi)), bent(kPi)) << "half a turn: as asked";
  EXPECT_EQ(model.nearest_equivalent(bent(0.0), bent(-kPi)), bent(-kPi));
  const std::vector<Configuration> path =
      model.unwrapped({bent(-3.0), bent(-1.0), bent(1.0), bent(3.0)}, bent(3.0));
  EXPECT_DOUBLE_EQ(path.front()[0], 2 * kPi - 3.0);
  EXPECT_DOUBLE_EQ(path.back()[0], 2 * kPi + 3.0);
}

TEST(ContinuousJoints, TurnByHalfTurnsAtMostWhereAPathIsCutIntoSuch) {
  RobotDescription robot = finger(1.0, 0.0, -kInfinity, kInfinity);
  robot.joints.front().limits = {-kInfinity, kInfinity};
  const RobotModel model(robot);
  EXPECT_THAT(model.in_half_turns({bent(0.0), bent(6.0), bent(6.0 + kPi)}),
              ElementsAre(bent(0.0), bent(3.0), bent(6.0), bent(6.0 + kPi)));
}

TEST(ContinuousJoints, AreLimitedToATurnEachWayByAGearThatIsElsewhereAfterATurn) {
  for (const double gear : {0.5, -2.5}) {
    RobotDescription robot = finger(gear, 0.0, -kInfinity, kInfinity);
    robot.joints.front().limits = {-kInfinity, kInfinity};
    const RobotModel model(robot);
    EXPECT_FALSE(model.is_continuous(0));
    EXPECT_DOUBLE_EQ(model.upper()[0], 2 * kPi);
    EXPECT_THAT(model.description().warnings,
                ElementsAre(AllOf(HasSubstr("knuckle"), HasSubstr("tip"))));
  }
}

TEST(ContinuousJoints, TakeTheLimitsOfWhatFollowsThem) {
  RobotDescription robot = finger(1.0, 0.0, -1.0, 2.0);
  robot.joints.front().limits = {-kInfinity, kInfinity};
  const RobotModel model(robot);
  EXPECT_FALSE(model.is_continuous(0));
  EXPECT_DOUBLE_EQ(model.lower()[0], -1.0);
}

TEST(CoupledLimits, LeaveARangeAloneThatTheyAllow) {
  for (const double rounding : {0.0, 1e-13, -1e-13}) {
    const RobotModel model(finger(0.5, 0.0, -0.5, 1.0 - rounding));
    EXPECT_EQ(model.lower()[0], -1.0);
    EXPECT_EQ(model.upper()[0], 2.0) << "to the bit, whatever a file's rounding";
    EXPECT_THAT(model.description().warnings, IsEmpty());
  }
}

TEST(CoupledLimits, AreRefusedIfNoConfigurationKeepsThem) {
  EXPECT_THAT(test::refusal_of([] { RobotModel(finger(1.0, 0.0, 2.5, 3.0)); }),
              AllOf(HasSubstr("joint tip"), HasSubstr("knuckle")));
  EXPECT_THAT(test::refusal_of([] { RobotModel(finger(0.0, 1.0, -0.5, 0.5)); }),
              HasSubstr("joint tip"));
}

TEST(CoupledLimits, AreRefusedWithNumbersThatMakeNoCoupling) {
  for (const double bad : {1e300, -1e7, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(test::refusal_of([&] { RobotModel(finger(bad, 0.0, -1.0, 1.0)); }),
                HasSubstr("multiplier"))
        << bad;
    EXPECT_THAT(test::refusal_of([&] { RobotModel(finger(1.0, bad, -1.0, 1.0)); }),
                HasSubstr("offset"))
        << bad;
  }
}

TEST(CoupledLimits, AreNamedByTheJointThatFollows) {
  auto model = std::make_shared<const RobotModel>(finger(2.0, 0.0, -1.0, 1.0));
  EXPECT_THAT(limit_violations(*model, bent(0.5)), IsEmpty());
  const auto violations = limit_violations(*model, bent(0.9));
  ASSERT_EQ(violations.size(), 1U);
  EXPECT_EQ(violations[0].joint, "tip");
  EXPECT_DOUBLE_EQ(violations[0].value, 1.8);
  EXPECT_THAT(to_string(violations[0]), AllOf(HasSubstr("tip at 1.8"), HasSubstr("knuckle")));
  RobotState state(model);
  state.set_configuration(bent(0.9));
  EXPECT_FALSE(state.within_limits());
}

// This occurs if a scene has a limit with six decimals, or a right angle as 1.5708.
TEST(LimitViolations, ShowByWhatALimitIsExceeded) {
  const LimitViolation far{"tip", 0.9, -0.5, 0.5, ""};
  EXPECT_EQ(to_string(far), "joint tip at 0.9000 rad, allowed -0.5000 to 0.5000 (22.9° beyond)");
  const LimitViolation close{"tip", -0.069813, -1.3089969, -0.0698132, ""};
  EXPECT_EQ(to_string(close),
            "joint tip at -0.0698130 rad, allowed -1.3089969 to -0.0698132 (1.1e-05° beyond)");
  const LimitViolation slide{"rail", -0.0009, 0.0, 0.4, "", JointType::kPrismatic};
  EXPECT_EQ(to_string(slide), "joint rail at -0.0009 m, allowed 0.0000 to 0.4000 (0.9 mm beyond)");
}

TEST(CoupledLimits, OfAnyJointComeInTheOrderOfTheLinks) {
  RobotDescription robot = finger(0.5, 0.0, -0.5, 1.0);
  robot.links.push_back({"thumb", {}, {}});
  robot.joints.push_back(turning("thumb", "palm", "thumb", -1.0, 1.0));
  const RobotModel model(robot);
  const auto violations = limit_violations(model, Eigen::Vector2d(2.5, -1.5));
  ASSERT_EQ(violations.size(), 2U);
  EXPECT_EQ(violations[0].joint, "tip") << "knuckle, by what follows it";
  EXPECT_EQ(violations[1].joint, "thumb");
  EXPECT_EQ(violations[1].leader, "");
}

TEST(JointLimits, AreRefusedWhenTheyMakeNoSense) {
  const auto refusal = [](auto change) {
    RobotDescription robot = finger(0.5, 0.0, -0.5, 1.0);
    change(robot.joints.front().limits);
    return test::refusal_of([&] { RobotModel{robot}; });
  };
  EXPECT_THAT(refusal([](JointLimits& limits) { limits.lower = -1e308; }), HasSubstr("knuckle"));
  EXPECT_THAT(refusal([](JointLimits& limits) { limits.upper = -2.0; }), HasSubstr("lower below"));
  EXPECT_THAT(refusal([](JointLimits& limits) { limits.velocity = -1.0; }), HasSubstr("velocity"));
  EXPECT_THAT(refusal([](JointLimits& limits) {
                limits.acceleration = std::numeric_limits<double>::quiet_NaN();
              }),
              HasSubstr("acceleration"));
}

}  // namespace
}  // namespace handway::geometric
