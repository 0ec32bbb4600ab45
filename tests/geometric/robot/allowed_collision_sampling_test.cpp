#include <handway/geometric/setup/collision_sampling.h>

#include <gtest/gtest.h>

#include <stdexcept>

namespace handway::geometric {
namespace {

/// Equal spheres: the arm carries one far above it, which carries one that comes
/// back to overlap the arm, and one that sweeps through the base.
RobotModel spheres() {
  RobotDescription robot;
  robot.name = "spheres";
  const auto add_link = [&](const std::string& name, double radius) {
    Link link{name, {}, {}};
    if (radius > 0.0) {
      link.collision.emplace_back().shape = Sphere{radius};
    }
    robot.links.push_back(link);
  };
  const auto add_joint = [&](const std::string& parent, const std::string& child,
                             const Eigen::Vector3d& p_PJ, JointType type) {
    Joint joint;
    joint.name = child + "_joint";
    joint.type = type;
    joint.parent = parent;
    joint.child = child;
    joint.X_PJ.translation() = p_PJ;
    joint.limits.lower = -3.0;
    joint.limits.upper = 3.0;
    robot.joints.push_back(joint);
  };
  add_link("base", 0.1);
  add_link("frame", 0.0);
  add_link("arm", 0.1);
  add_link("far", 0.1);
  add_link("back", 0.1);
  add_link("sweeper", 0.1);
  add_joint("base", "frame", {0.5, 0, 0}, JointType::kFixed);
  add_joint("frame", "arm", {0.5, 0, 0}, JointType::kRevolute);
  add_joint("arm", "far", {0, 0, 5}, JointType::kRevolute);
  add_joint("far", "back", {0.1, 0, -5}, JointType::kRevolute);
  add_joint("arm", "sweeper", {-1, 0, 0}, JointType::kRevolute);
  return RobotModel(robot);
}

AllowedCollisions sample_allowed_collisions(const RobotModel& model, int samples,
                                            std::uint64_t seed) {
  return allowed_collisions(model, sample_self_collisions(model, samples, seed));
}

TEST(AllowedCollisionSampling, FindsAdjacentLinksAcrossLinksWithoutGeometry) {
  const AllowedCollisions allowed = adjacent_links(spheres());
  EXPECT_EQ(allowed.entries().size(), 4U);
  EXPECT_EQ(allowed.reason("base", "arm"), AllowedReason::kAdjacent);
  EXPECT_EQ(allowed.reason("arm", "sweeper"), AllowedReason::kAdjacent);
}

TEST(AllowedCollisionSampling, TellsAlwaysFromNeverFromSometimes) {
  const AllowedCollisions allowed = sample_allowed_collisions(spheres(), 200, 1);
  EXPECT_EQ(allowed.reason("base", "arm"), AllowedReason::kAdjacent);
  EXPECT_EQ(allowed.reason("far", "back"), AllowedReason::kAdjacent) << "not Never";
  EXPECT_EQ(allowed.reason("arm", "back"), AllowedReason::kAlways);
  EXPECT_EQ(allowed.reason("base", "far"), AllowedReason::kNever);
  EXPECT_FALSE(allowed.reason("base", "sweeper")) << "in collision only now and then";
}

/// Two jaws that one joint opens by at most 0.04 m each; they overlap by `overlap` (m) if closed.
RobotModel gripper(double overlap) {
  RobotDescription robot;
  robot.links.push_back({"palm", {}, {}});
  for (const double side : {1.0, -1.0}) {
    const std::string name = side > 0 ? "left" : "right";
    Link& jaw = robot.links.emplace_back(Link{name, {}, {}});
    jaw.collision.emplace_back().shape = Box{{0.02, 0.01 + overlap, 0.04}};
    Joint& joint = robot.joints.emplace_back();
    joint.name = name + "_slide";
    joint.type = JointType::kPrismatic;
    joint.parent = "palm";
    joint.child = name;
    joint.axis = side * Eigen::Vector3d::UnitY();
    joint.X_PJ.translation() = Eigen::Vector3d(0.0, side * 0.005, 0.05);
    joint.limits = {0.0, 0.04, 1.0};
  }
  robot.joints.back().mimic = Mimic{"left_slide", 1.0, 0.0};
  return RobotModel(robot);
}

TEST(AllowedCollisionSampling, LetsJawsTouchThatMeetWhereTheirJointEnds) {
  EXPECT_EQ(sample_allowed_collisions(gripper(1e-5), 1000, 1).reason("left", "right"),
            AllowedReason::kDefault);
  EXPECT_EQ(sample_overlapping_links(gripper(1e-5), 200, 1).reason("left", "right"),
            AllowedReason::kDefault);
  EXPECT_FALSE(sample_allowed_collisions(gripper(0.01), 1000, 1).reason("left", "right"))
      << "they can be driven into each other";
}

TEST(AllowedCollisionSampling, LetsNoOtherLinksTouchThatDoSoAtAnEnd) {
  RobotDescription robot = gripper(1e-5).description();
  robot.joints.back().mimic.reset();
  EXPECT_FALSE(sample_allowed_collisions(RobotModel(robot), 1000, 1).reason("left", "right"));
}

TEST(AllowedCollisionSampling, GivesTheSameMatrixForTheSameSeed) {
  EXPECT_EQ(sample_allowed_collisions(spheres(), 20, 7).entries(),
            sample_allowed_collisions(spheres(), 20, 7).entries());
}

TEST(AllowedCollisionSampling, TakesNoNoticeOfThePresentMatrix) {
  RobotDescription robot = spheres().description();
  robot.allowed_collisions.allow("base", "sweeper", AllowedReason::kUser);
  EXPECT_EQ(sample_allowed_collisions(RobotModel(robot), 100, 3).entries(),
            sample_allowed_collisions(spheres(), 100, 3).entries());
}

TEST(AllowedCollisionSampling, CountsNoCollisionsOfPairsThatTheUserAllows) {
  RobotDescription robot = gripper(0.01).description();
  const auto colliding = [&] {
    return sample_self_collisions(RobotModel(robot), 1000, 1).colliding;
  };
  EXPECT_GT(colliding(), 0);
  robot.allowed_collisions.allow("left", "right", AllowedReason::kUser);
  EXPECT_EQ(colliding(), 0);
}

TEST(AllowedCollisionSampling, NeedsASample) {
  EXPECT_THROW(static_cast<void>(sample_allowed_collisions(spheres(), 0, 1)),
               std::invalid_argument);
}

}  // namespace
}  // namespace handway::geometric
