#include "handway/geometric/collision/continuous/motion_bound.h"

#include "../robot/random_configurations.h"
#include "handway_test/solid_robots.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

using test::add_object;
using test::RandomConfigurations;
using test::scene_of;

/// All bodies and links in the world, in one configuration.
struct Placed {
  Placed(const CollisionWorld& world, const Configuration& q)
      : X_BL(static_cast<std::size_t>(world.model().link_count())), X_WBody(world.bodies().size()) {
    world.place(q, X_BL, X_WBody);
  }
  std::vector<Pose> X_BL;
  std::vector<Pose> X_WBody;
};

// The link that carries both bodies; -1 if one of them stands still.
int common_carrier(const CollisionWorld& world, const BodyPair& pair) {
  int a = world.body(pair.a).link;
  int b = world.body(pair.b).link;
  while (a != b && b >= 0) {
    (a > b ? a : b) = world.model().parent(std::max(a, b));
  }
  return b;
}

double farthest(const TriangleMesh& mesh, const Pose& before, const Pose& after) {
  double most = 0.0;
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    most = std::max(most, (after * vertex - before * vertex).norm());
  }
  return most;
}

// Each point of a body is where its motion about the middle takes it, to within its bend.
void expect_motion_holds(const TriangleMesh& mesh, const Pose& before, const Pose& after,
                         const PointMotion& motion, double share) {
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    const Eigen::Vector3d p = before * vertex;
    const Eigen::Vector3d moved = p + share * (motion.v + motion.w.cross(p));
    EXPECT_LE((after * vertex - moved).norm(), 0.5 * share * share * motion.bend + 1e-9);
  }
}

// The distance of two bodies changes by at most the travel of the points of both, seen from the
// link that carries both.
void expect_bounds_hold(const CollisionWorld& world, const Configuration& from,
                        const Configuration& to) {
  const MotionBound motion(world);
  const Placed before(world, from);
  const Placed after(world, to);
  const Eigen::VectorXd travel = (to - from).cwiseAbs();
  EdgeMotion edge(std::make_shared<const MotionBound>(world));
  edge.set_edge(4.0 * (to - from));
  edge.set_middle(before.X_BL);
  for (std::size_t p = 0; p < world.pairs().size(); ++p) {
    const BodyPair& pair = world.pairs()[p];
    const int carrier = common_carrier(world, pair);
    const auto carrier_of = [&](const Placed& placed) -> Pose {
      return carrier < 0 ? Pose::Identity()
                         : world.X_WB() * placed.X_BL[static_cast<std::size_t>(carrier)];
    };
    const auto seen = [&](const Placed& placed, int body) -> Pose {
      return carrier_of(placed).inverse() * placed.X_WBody[static_cast<std::size_t>(body)];
    };
    const auto travelled = [&](int body) {
      return farthest(*world.body(body).mesh, seen(before, body), seen(after, body));
    };
    const double both = travelled(pair.a) + travelled(pair.b);
    const std::string names = world.body(pair.a).name + " with " + world.body(pair.b).name;
    SCOPED_TRACE(names);
    const PairMotion motions = edge.pair_motion(static_cast<int>(p));
    for (const auto& [body, moving] :
         {std::pair(pair.a, motions.a), std::pair(pair.b, motions.b)}) {
      expect_motion_holds(*world.body(body).mesh, carrier_of(before) * seen(before, body),
                          carrier_of(before) * seen(after, body), moving, 0.25);
    }
    EXPECT_LE(both, motion.bound(static_cast<int>(p), travel) + 1e-9) << names;
    const double on_edge = edge.within(static_cast<int>(p), 0.25);
    EXPECT_LE(both, on_edge + 1e-9) << names;
    EXPECT_LE(on_edge, motion.bound(static_cast<int>(p), travel) + 1e-9) << names;
  }
  for (std::size_t i = 0; i < world.bodies().size(); ++i) {
    EXPECT_LE(farthest(*world.bodies()[i].mesh, before.X_WBody[i], after.X_WBody[i]),
              motion.any_point(travel) + 1e-9)
        << world.bodies()[i].name;
  }
}

void expect_bounds_hold_everywhere(const Scene& scene, int moves) {
  const CollisionWorld world(scene);
  RandomConfigurations random(world.model(), 11);
  for (int i = 0; i < moves; ++i) {
    const Configuration from = random.next();
    // Long and short moves, and those of a single joint.
    expect_bounds_hold(world, from, random.next());
    expect_bounds_hold(world, from, from + 1e-3 * (random.next() - from));
    Configuration to = from;
    const int v = i % world.model().variable_count();
    to[v] = random.next()[v];
    expect_bounds_hold(world, from, to);
    if (testing::Test::HasFailure()) {
      return;
    }
  }
}

TEST(MotionBound, HoldsForTheHandArmRobot) {
  Scene scene = scene_of(test::solid_tx90_sah());
  add_object(scene, "table", Box{{1, 1, 0.1}}, Eigen::Vector3d(0.5, 0, 0));
  add_object(scene, "can", Cylinder{0.03, 0.12}, Eigen::Vector3d(0.05, 0, 0.2));
  scene.objects.back().attachment = Attachment{"tx90_sah", "Palm", {}};
  expect_bounds_hold_everywhere(scene, 40);
}

TEST(MotionBound, HoldsForCoupledJoints) {
  Scene scene = scene_of(test::planar_hand_arm());
  add_object(scene, "post", Cylinder{0.03, 0.2}, Eigen::Vector3d(0.5, 0.5, 0));
  expect_bounds_hold_everywhere(scene, 60);
}

// A turntable that lifts itself as its motor turns; its slide's own limits are ignored: only the
// leader's count.
RobotDescription screw() {
  RobotDescription robot = test::gantry(Box{{0.1, 0.1, 0.1}});
  robot.joints[0].type = JointType::kRevolute;
  robot.joints[0].axis = Eigen::Vector3d::UnitZ();
  robot.joints[0].limits = {-3, 3};
  robot.joints[1].limits = {-0.2, 0.2};
  robot.joints[1].mimic = Mimic{"z", -2.0, 0.5};
  robot.joints[2].limits = {-0.4, 0.8};
  return robot;
}

TEST(MotionBound, HoldsForCoupledSlides) {
  Scene scene = scene_of(screw());
  add_object(scene, "post", Cylinder{0.03, 0.2}, Eigen::Vector3d(0.5, 0.5, 0));
  expect_bounds_hold_everywhere(scene, 60);
}

TEST(MotionBound, IsTightForOneJoint) {
  Scene scene = scene_of(test::planar_hand_arm());
  add_object(scene, "post", Cylinder{0.03, 0.2}, Eigen::Vector3d(0.5, 0.5, 0));
  const CollisionWorld world(scene);
  const MotionBound motion(world);
  const auto shoulder = static_cast<int>(world.model().find_variable("shoulder").value());
  const Eigen::VectorXd unit = Eigen::VectorXd::Unit(world.model().variable_count(), shoulder);
  for (std::size_t p = 0; p < world.pairs().size(); ++p) {
    const auto [a, b] = world.pairs()[p];
    if (world.body(a).name == "upper" && world.body(b).name == "post") {
      EXPECT_NEAR(motion.bound(static_cast<int>(p), unit), std::hypot(0.29, 0.02), 1e-12);
    }
    if (world.body(a).name == "lower" && world.body(b).name == "post") {
      EXPECT_NEAR(motion.bound(static_cast<int>(p), unit),
                  0.3 + Eigen::Vector3d(0.29, 0.02, 0.015).norm(), 1e-12);
    }
    if (world.is_self_pair(world.pairs()[p])) {
      const bool moves = world.body(a).name == "base" || world.body(b).name == "base";
      EXPECT_EQ(motion.bound(static_cast<int>(p), unit) > 0.0, moves);
    }
  }
}

TEST(MotionBound, MeasuresSlidesInMetres) {
  Scene scene = scene_of(test::gantry(Box{}));
  add_object(scene, "table", Box{}, Eigen::Vector3d(0, 0, -2));
  const MotionBound motion{CollisionWorld(scene)};
  EXPECT_DOUBLE_EQ(motion.bound(0, Eigen::Vector3d(0.1, 0.02, 0.003)), 0.123);
  EXPECT_DOUBLE_EQ(motion.any_point(Eigen::Vector3d(0.1, 0.02, 0.003)), 0.123);
}

TEST(EdgeMotion, SeesThatJointsCancelOut) {
  Scene scene = scene_of(test::planar_hand_arm());
  add_object(scene, "post", Cylinder{0.03, 0.2}, Eigen::Vector3d(0.5, 0.5, 0));
  const CollisionWorld world(scene);
  Configuration q = world.model().neutral();
  Configuration delta = Configuration::Zero(q.size());
  delta[world.model().find_variable("shoulder").value()] = 1.0;
  delta[world.model().find_variable("elbow").value()] = -1.0;  // "lower" does not turn
  EdgeMotion edge(std::make_shared<const MotionBound>(world));
  edge.set_edge(delta);
  const Placed middle(world, q);
  edge.set_middle(middle.X_BL);
  for (std::size_t p = 0; p < world.pairs().size(); ++p) {
    const auto [a, b] = world.pairs()[p];
    if (world.body(a).name == "lower" && world.body(b).name == "post") {
      EXPECT_NEAR(edge.within(static_cast<int>(p), 0.01), 0.01 * 0.3, 1e-4);
      EXPECT_GT(edge.over_edge(static_cast<int>(p)), 0.85);
    }
  }
}

}  // namespace
}  // namespace handway::geometric
