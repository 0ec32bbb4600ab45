#include "mujoco_hold_test.h"

#include "handway/geometric/math/units.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

namespace handway::simulate_mujoco {
namespace {

using Eigen::Vector3d;
using geometric::Pose;
using planning::CarryResult;
using planning::HoldConditions;
using planning::HoldResult;
using planning::Pregrasp;

geometric::Link box_link(const std::string& name, const Vector3d& size) {
  return {name, {}, {{geometric::Box{size}, Pose::Identity(), {}}}};
}

geometric::Joint slide(const std::string& child, const Vector3d& from, const Vector3d& axis) {
  geometric::Joint joint;
  joint.name = child + "_slide";
  joint.type = geometric::JointType::kPrismatic;
  joint.parent = "palm";
  joint.child = child;
  joint.X_PJ.translation() = from;
  joint.axis = axis;
  joint.limits = {0.0, 0.05};
  return joint;
}

/// A gripper of two jaws, 40 mm high and wide, that close along y on what is at the origin; its
/// palm is a plate above.
geometric::RobotDescription gripper() {
  geometric::RobotDescription robot;
  robot.name = "gripper";
  robot.links = {box_link("palm", {0.2, 0.2, 0.01}), box_link("left", {0.04, 0.01, 0.04}),
                 box_link("right", {0.04, 0.01, 0.04})};
  // The palm's frame is 0.1 m above the jaws.
  robot.joints = {slide("left", {0.0, -0.055, -0.1}, Vector3d::UnitY()),
                  slide("right", {0.0, 0.055, -0.1}, -Vector3d::UnitY())};
  return robot;
}

planning::PlanningProblem problem_of(const geometric::RobotDescription& robot, const Pose& X_WB,
                                     const geometric::Shape& shape, const Pose& X_WO) {
  geometric::Scene scene;
  scene.name = "test";
  geometric::RobotInstance instance;
  instance.name = robot.name;
  instance.model = std::make_shared<const geometric::RobotModel>(robot);
  instance.X_WB = X_WB;
  instance.configuration = instance.model->neutral();
  scene.robots = {instance};
  geometric::SceneObject object;
  object.name = "object";
  object.shape = shape;
  object.X_PO = X_WO;
  scene.objects = {object};
  return planning::make_problem(std::make_shared<const geometric::Scene>(scene), nullptr, {},
                                planning::GoalNeed::kOptional);
}

/// A cube of 60 mm between the jaws.
class Gripper : public testing::Test {
 protected:
  Gripper() {
    grasp_.closed = Eigen::Vector2d(0.0195, 0.0195);    // 0.5 mm from the cube
    grasp_.squeezed = Eigen::Vector2d(0.0495, 0.0495);  // 30 mm into it
    grasp_.q = grasp_.closed;
    conditions_.contact.friction = 0.5;
    conditions_.slide_force = 10.0;  // N
  }

  static planning::PlanningProblem problem() {
    Pose X_WB = Pose::Identity();
    X_WB.translation().z() = 0.1;
    return problem_of(gripper(), X_WB, geometric::Box{{0.06, 0.06, 0.06}}, Pose::Identity());
  }

  MujocoHoldTest test_{problem(), "object", 0};
  Pregrasp grasp_;
  HoldConditions conditions_;
};

TEST_F(Gripper, LiftsWhatTwiceTheFrictionOfAJawCarries) {
  // m g = 2 µ F
  const double most = 2.0 * conditions_.contact.friction * conditions_.slide_force / 9.81;
  conditions_.mass = 0.97 * most;
  EXPECT_TRUE(test_.test(grasp_, conditions_, {}, {}).lift->held);
  conditions_.mass = 1.03 * most;
  EXPECT_FALSE(test_.test(grasp_, conditions_, {}, {}).lift->held);
}

TEST_F(Gripper, HoldsAgainstForcesUpToItsFriction) {
  // Along x and z friction holds, up to 2 µ F = 10 N, along y the jaws themselves.
  conditions_.force = 9.0;
  EXPECT_EQ(test_.test(grasp_, conditions_, {}, {}).directions_held(), 6);
  conditions_.force = 11.0;
  const HoldResult result = test_.test(grasp_, conditions_, {}, {});
  EXPECT_FALSE(result.held());
  EXPECT_FALSE(result.directions[0].held);
  EXPECT_FALSE(result.directions[5].held);
}

/// A motion of the palm along x: with constant acceleration (m/s²) for half of the time, and then
/// with the same deceleration.
planning::PalmMotion shove(double acceleration, double duration) {
  planning::PalmMotion motion;
  const double half = 0.5 * duration;
  for (double t = 0.0; t <= duration; t += motion.period) {
    const double left = duration - t;
    Pose X_WP = Pose::Identity();
    const double x =
        t < half ? 0.5 * acceleration * t * t : acceleration * (half * half - 0.5 * left * left);
    X_WP.translation() = Vector3d(x, 0.0, 0.1);
    motion.X_WP.push_back(X_WP);
  }
  return motion;
}

TEST_F(Gripper, CarriesAsFastAsItsFrictionAllows) {
  // m sqrt(g² + a²) = 2 µ F
  conditions_.mass = 0.5;
  const double most = 2.0 * conditions_.contact.friction * conditions_.slide_force;
  const double limit = std::sqrt(std::pow(most / conditions_.mass, 2) - std::pow(9.81, 2));
  const CarryResult slow = test_.carry(grasp_, shove(0.95 * limit, 0.8), conditions_, {}, {});
  EXPECT_TRUE(slow.held());
  EXPECT_LT(slow.slip.shift, 0.005);
  EXPECT_NEAR(slow.time, 0.8, 0.005);
  const CarryResult fast = test_.carry(grasp_, shove(1.2 * limit, 0.8), conditions_, {}, {});
  EXPECT_FALSE(fast.held());
  EXPECT_LT(fast.time, 0.8);
}

TEST_F(Gripper, CarriesOnACircleAsFastAsItsFrictionAllows) {
  // The palm turns about the vertical at a distance: m sqrt(g² + (w² r)²) = 2 µ F.
  static constexpr double kRadius = 0.5;  // m
  static constexpr double kRise = 1.0;    // s, until the speed is reached
  const auto turn = [](double speed) {
    planning::PalmMotion motion;
    double angle = 0.0;
    for (double t = 0.0; t < 2.0 + kRise; t += motion.period) {
      const double s = std::min(t / kRise, 1.0);
      angle += motion.period * speed * s * s * (3.0 - 2.0 * s);
      Pose X_WP = Pose::Identity();
      X_WP.rotate(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
      X_WP.translate(Vector3d(kRadius, 0.0, 0.1));
      motion.X_WP.push_back(X_WP);
    }
    return motion;
  };
  conditions_.mass = 0.5;
  const double most = 2.0 * conditions_.contact.friction * conditions_.slide_force;
  const double limit =
      std::sqrt(std::sqrt(std::pow(most / conditions_.mass, 2) - std::pow(9.81, 2)) / kRadius);
  Pose X_WO = Pose::Identity();
  X_WO.translation().x() = kRadius;
  Pose X_WB = X_WO;
  X_WB.translation().z() = 0.1;
  const MujocoHoldTest test(problem_of(gripper(), X_WB, geometric::Box{{0.06, 0.06, 0.06}}, X_WO),
                            "object", 0);
  EXPECT_TRUE(test.carry(grasp_, turn(0.93 * limit), conditions_, {}, {}).held());
  EXPECT_FALSE(test.carry(grasp_, turn(1.15 * limit), conditions_, {}, {}).held());
}

TEST_F(Gripper, TellsForcesAndTorquesOfCarrying) {
  conditions_.mass = 0.2;
  const CarryResult result = test_.carry(grasp_, shove(1.0, 0.5), conditions_, {}, {});
  ASSERT_EQ(result.forces.size(), 2U);
  EXPECT_EQ(result.forces[0].link, "left");
  EXPECT_NEAR(result.forces[0].largest, conditions_.slide_force, 0.1 * conditions_.slide_force);
  EXPECT_NEAR(result.torque_share, 1.0, 0.01);
  EXPECT_THROW(static_cast<void>(test_.carry(grasp_, {}, conditions_, {}, {})),
               std::invalid_argument);
}

TEST_F(Gripper, ShowsTheForcesThatCarryTheObject) {
  conditions_.mass = 0.5;
  planning::HoldFrame last;
  static_cast<void>(test_.carry(grasp_, shove(0.0, 0.8), conditions_, {},
                                [&](const planning::HoldFrame& frame) { last = frame; }));
  Vector3d sum = Vector3d::Zero();
  double normal = 0.0;
  for (const planning::ContactForce& force : last.forces) {
    sum += force.f_W;
    normal += std::abs(force.f_W.y());
    EXPECT_NEAR(std::abs(force.p_W.y() - last.X_WO.translation().y()), 0.03, 1e-3) << "its sides";
  }
  EXPECT_LT((sum - Vector3d(0.0, 0.0, 0.5 * 9.81)).norm(), 0.05 * 0.5 * 9.81) << "the weight, N";
  EXPECT_NEAR(normal, 2.0 * conditions_.slide_force, 0.1 * conditions_.slide_force);
}

TEST_F(Gripper, HoldsNothingWithoutSqueeze) {
  grasp_.squeezed = grasp_.closed;
  const HoldResult result = test_.test(grasp_, conditions_, {}, {});
  EXPECT_FALSE(result.held());
  EXPECT_FALSE(result.lift->held);
}

TEST_F(Gripper, GivesTheSameResultEveryTime) {
  const HoldResult a = test_.test(grasp_, conditions_, {}, {});
  const HoldResult b = test_.test(grasp_, conditions_, {}, {});
  ASSERT_EQ(a.directions.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(a.directions[i].shift, b.directions[i].shift);
    EXPECT_EQ(a.directions[i].turn, b.directions[i].turn);
  }
  EXPECT_EQ(a.lift->shift, b.lift->shift);
}

TEST_F(Gripper, TestsOnAnyNumberOfThreadsAlike) {
  std::vector<Pregrasp> grasps(3, grasp_);
  grasps[1].squeezed = Eigen::Vector2d(0.025, 0.03);
  grasps[2].squeezed = Eigen::Vector2d(0.022, 0.022);
  const auto one = planning::rank_by_tests(test_, grasps, 3, conditions_, 1);
  const auto four = planning::rank_by_tests(test_, grasps, 3, conditions_, 4);
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_TRUE(one[i].hold && four[i].hold);
    EXPECT_EQ(one[i].hold->lift->shift, four[i].hold->lift->shift);
  }
}

TEST_F(Gripper, FindsItsMargins) {
  conditions_.mass = 0.25;
  const planning::HoldMargins margins = planning::hold_margins(test_, grasp_, conditions_);
  ASSERT_TRUE(margins.least_friction && margins.largest_mass && margins.position_error);
  // The weight needs 0.25 · 9.81 / 20 = 0.12, a disturbance of 1 N less.
  EXPECT_NEAR(*margins.least_friction, 0.125, 0.015);
  EXPECT_NEAR(*margins.largest_mass, 1.02, 0.06);
  EXPECT_EQ(*margins.position_error, 0.01) << "the jaws bring the cube back between them";
}

TEST_F(Gripper, HasNoMarginsWhereNothingIsHeld) {
  grasp_.squeezed = grasp_.closed;
  const planning::HoldMargins margins = planning::hold_margins(test_, grasp_, conditions_);
  EXPECT_FALSE(margins.least_friction || margins.largest_mass || margins.position_error);
}

TEST_F(Gripper, ShowsEachLoadInOrder) {
  std::vector<planning::HoldFrame> frames;
  const HoldResult result = test_.test(
      grasp_, conditions_, {}, [&](const planning::HoldFrame& frame) { frames.push_back(frame); });
  ASSERT_FALSE(frames.empty());
  EXPECT_EQ(frames.front().load, 0);
  EXPECT_EQ(frames.back().load, 7);
  EXPECT_TRUE(frames.front().X_WO.isApprox(Pose::Identity(), 1e-9));
  EXPECT_TRUE(frames.front().q.isApprox(grasp_.closed));
  for (std::size_t i = 1; i < frames.size(); ++i) {
    EXPECT_TRUE(frames[i].load > frames[i - 1].load || frames[i].time > frames[i - 1].time);
  }
  EXPECT_TRUE(result.lift->held);
  EXPECT_LT((frames.back().X_WO.translation() - frames.front().X_WO.translation()).norm(), 0.005);
}

TEST_F(Gripper, EndsWhenItIsStopped) {
  std::stop_source stop;
  stop.request_stop();
  const HoldResult result = test_.test(grasp_, conditions_, stop.get_token(), {});
  EXPECT_FALSE(result.lift);
  EXPECT_FALSE(result.held());
  EXPECT_FALSE(
      planning::rank_by_tests(test_, {grasp_}, 1, conditions_, 1, stop.get_token()).front().hold);
}

/// A block that lies on a plate, without fingers.
class Incline : public testing::TestWithParam<double> {
 protected:
  static bool stays(double tilt, double friction) {
    geometric::RobotDescription robot;
    robot.name = "plate";
    robot.links = {{"base", {}, {}}, box_link("plate", {1.0, 1.0, 0.02})};
    geometric::Joint joint;
    joint.name = "tilt";
    joint.type = geometric::JointType::kRevolute;
    joint.parent = "base";
    joint.child = "plate";
    joint.axis = Vector3d::UnitY();
    joint.limits = {-1.5, 1.5};
    robot.joints = {joint};
    Pose X_WO = Pose::Identity();
    X_WO.rotate(Eigen::AngleAxisd(tilt, Vector3d::UnitY()));
    X_WO.translate(Vector3d(0.0, 0.0, 0.01 + 0.01));
    const MujocoHoldTest test(
        problem_of(robot, Pose::Identity(), geometric::Box{{0.1, 0.1, 0.02}}, X_WO), "object", 1);
    Pregrasp grasp;
    grasp.q = grasp.closed = grasp.squeezed = Eigen::VectorXd::Constant(1, tilt);
    HoldConditions conditions;
    conditions.contact.friction = friction;
    return test.test(grasp, conditions, {}, {}).lift->held;
  }
};

TEST_P(Incline, HoldsABlockUpToTheAngleOfFriction) {
  const double friction = GetParam();
  const double most = std::atan(friction);
  EXPECT_TRUE(stays(most - geometric::radians(1.0), friction));
  EXPECT_FALSE(stays(most + geometric::radians(1.0), friction));
}

INSTANTIATE_TEST_SUITE_P(Frictions, Incline, testing::Values(0.3, 0.6, 0.9));

TEST(MujocoHoldTest, RefusesWhatHasNoVolume) {
  geometric::Mesh sheet;
  auto triangles = std::make_shared<geometric::TriangleMesh>();
  triangles->vertices = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}};
  triangles->triangles = {{0, 1, 2}};
  sheet.triangles = triangles;
  const auto make = [&] {
    MujocoHoldTest(problem_of(gripper(), Pose::Identity(), sheet, Pose::Identity()), "object", 0);
  };
  EXPECT_THAT(test::refusal_of(make), testing::HasSubstr("a flat surface"));
}

TEST(MujocoHoldTest, HoldsTheCanOfThePaper) {
  const planning::SceneState loaded =
      planning::load_scene(test::source_dir() / "scenes" / "can_on_table.yaml", {});
  const planning::PlanningProblem problem = planning::make_problem(loaded.scene, loaded.basis);
  for (const double mass : {0.1, 0.3, 0.6}) {  // kg
    const planning::Pregrasps grasps = planning::find_pregrasps(problem, "can", {.payload = mass});
    ASSERT_FALSE(grasps.found.empty());
    const MujocoHoldTest test(problem, "can", grasps.palm);
    const HoldResult result = test.test(grasps.found.front(), {.mass = mass}, {}, {});
    EXPECT_TRUE(result.held()) << mass;
    EXPECT_TRUE(result.lift->held) << mass;
    if (mass <= 0.3) {  // that of the paper's can
      EXPECT_LT(result.lift->shift, 0.005) << mass;
    }
  }
}

}  // namespace
}  // namespace handway::simulate_mujoco
