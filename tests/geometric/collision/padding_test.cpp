/// Padding against distances that FCL measures between the surfaces as they are.
#include "../robot/random_configurations.h"
#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway/geometric/collision/continuous/continuous_collision_checker.h"
#include "handway/geometric/collision/narrow_phase/contact.h"
#include "handway_test/scale.h"
#include "handway_test/solid_robots.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace handway::geometric {
namespace {

using test::add_object;

constexpr std::array kKinds{CheckerKind::kFast, CheckerKind::kFcl, CheckerKind::kFclBroadphase};

std::unique_ptr<CollisionChecker> checker_of(const Scene& scene,
                                             CheckerKind kind = CheckerKind::kFast) {
  return make_collision_checker(std::make_shared<const CollisionWorld>(scene), kind);
}

// A bar along x and two legs along z at its ends, open upwards; 20 cm wide, walls of 2 cm.
Shape u_shape() {
  TriangleMesh mesh;
  for (const auto& [size, p] :
       {std::pair(Eigen::Vector3d(0.24, 0.2, 0.02), Eigen::Vector3d(0, 0, 0)),
        std::pair(Eigen::Vector3d(0.02, 0.2, 0.2), Eigen::Vector3d(-0.11, 0, 0.1)),
        std::pair(Eigen::Vector3d(0.02, 0.2, 0.2), Eigen::Vector3d(0.11, 0, 0.1))}) {
    append(mesh, transformed(*tessellate(Box{size}), Pose(Eigen::Translation3d(p))));
  }
  return Mesh{{}, Eigen::Vector3d::Ones(), std::make_shared<const TriangleMesh>(std::move(mesh))};
}

Scene padded_gantry(const Shape& probe, double padding) {
  Scene scene = test::scene_of(test::gantry(probe));
  scene.robots.front().padding["probe"] = {1.0, padding};
  return scene;
}

TEST(Padding, IsADistanceFromConcaveLinksToo) {
  for (const CheckerKind kind : kKinds) {
    Scene scene = padded_gantry(u_shape(), 0.02);
    add_object(scene, "box", Box{{0.01, 0.01, 0.01}}, Eigen::Vector3d::Zero());
    const auto checker = checker_of(scene, kind);
    const auto collides = [&](double x, double z) {
      return checker->first_collision(Eigen::Vector3d(-x, 0.0, -z)).has_value();
    };
    EXPECT_TRUE(collides(0.0, 0.01 + 0.005 + 0.019)) << "19 mm above the bar";
    EXPECT_FALSE(collides(0.0, 0.01 + 0.005 + 0.021));
    EXPECT_TRUE(collides(0.1 - 0.005 - 0.003, 0.1)) << "3 mm inside of a leg";
    EXPECT_TRUE(collides(0.1 - 0.005 - 0.019, 0.1));
    EXPECT_FALSE(collides(0.1 - 0.005 - 0.021, 0.1));
    EXPECT_TRUE(collides(0.11, 0.1)) << "within the leg";
  }
}

TEST(Padding, OfALongBarIsTheSameAllAlongIt) {
  Scene scene = padded_gantry(test::as_mesh(Box{{1.0, 0.02, 0.02}}), 0.01);
  add_object(scene, "ball", Box{{0.002, 0.002, 0.002}}, Eigen::Vector3d::Zero());
  const auto checker = checker_of(scene);
  for (const double along : {-0.49, -0.2, 0.0, 0.3, 0.49}) {
    EXPECT_TRUE(checker->first_collision(Eigen::Vector3d(along, 0.0, 0.0209))) << along;
    EXPECT_FALSE(checker->first_collision(Eigen::Vector3d(along, 0.0, 0.0211))) << along;
  }
}

TEST(Padding, LeavesDistancesThatRemain) {
  Scene scene = padded_gantry(Box{{0.1, 0.1, 0.1}}, 0.01);
  add_object(scene, "wall", Box{{0.1, 1.0, 1.0}}, Eigen::Vector3d(0.5, 0.0, 0.0));
  for (const CheckerKind kind : kKinds) {
    const auto checker = checker_of(scene, kind);
    EXPECT_NEAR(find_clearance(*checker, Eigen::Vector3d(0.3, 0, 0)).distance, 0.09, 1e-9);
    EXPECT_EQ(find_clearance(*checker, Eigen::Vector3d(0.395, 0, 0)).distance, 0.0);
    checker->place(Eigen::Vector3d(0.38, 0, 0));  // 20 mm apart, 10 mm are left
    EXPECT_EQ(checker->pair_proximity(0, 0.0099), Proximity::kClear);
    EXPECT_EQ(checker->pair_proximity(0, 0.0101), Proximity::kWithinTolerance);
    checker->place(Eigen::Vector3d(0.395, 0, 0));
    EXPECT_EQ(checker->pair_proximity(0, 0.001), Proximity::kCollision);
    EXPECT_TRUE(is_closer_than(*checker, Eigen::Vector3d(0.38, 0, 0), 0.0101));
    EXPECT_FALSE(is_closer_than(*checker, Eigen::Vector3d(0.38, 0, 0), 0.0099));
  }
}

TEST(Padding, IsKeptAllAlongAnEdge) {
  Scene scene = padded_gantry(Box{{0.1, 0.1, 0.1}}, 0.01);
  add_object(scene, "post", Cylinder{0.01, 1.0}, Eigen::Vector3d(0.0, 0.065, 0.0));
  const auto checker = checker_of(scene);
  ContinuousCollisionChecker edges(*checker, std::make_shared<const MotionBound>(checker->world()),
                                   5e-5);
  EXPECT_FALSE(edges.check(Eigen::Vector3d(-0.5, 0.0, 0), Eigen::Vector3d(0.5, 0.0, 0)).free)
      << "passes at 5 mm";
  EXPECT_TRUE(edges.check(Eigen::Vector3d(-0.5, -0.01, 0), Eigen::Vector3d(0.5, -0.01, 0)).free)
      << "passes at 15 mm";
}

TEST(Padding, ShowsWhereAndByHowMuchItIsMissed) {
  Scene scene = padded_gantry(Box{{0.1, 0.1, 0.1}}, 0.01);
  add_object(scene, "wall", Box{{0.1, 1.0, 1.0}}, Eigen::Vector3d(0.5, 0.0, 0.0));
  const auto checker = checker_of(scene);
  const auto contacts = find_contacts(*checker, Eigen::Vector3d(0.396, 0, 0));
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_NEAR(contacts.front().p_W.x(), 0.448, 1e-6);
  EXPECT_NEAR(contacts.front().depth, 0.006, 2e-4);
}

TEST(Padding, OfRobotsThatStandStillAddsUp) {
  Scene scene = padded_gantry(Box{{0.1, 0.1, 0.1}}, 0.01);
  scene.robots.push_back(scene.robots.front());
  scene.robots.back().name = "other";
  scene.robots.back().X_WB = Eigen::Translation3d(0.5, 0, 0) * scene.robots.front().X_WB;
  scene.robots.back().padding["probe"] = {1.0, 0.02};
  const auto checker = checker_of(scene);
  EXPECT_TRUE(checker->first_collision(Eigen::Vector3d(0.371, 0, 0)));
  EXPECT_FALSE(checker->first_collision(Eigen::Vector3d(0.369, 0, 0)));
}

TEST(Padding, HoldsForWhatALinkCarries) {
  Scene scene = padded_gantry(Box{{0.1, 0.1, 0.1}}, 0.01);
  add_object(scene, "tool", Box{{0.02, 0.02, 0.2}}, Eigen::Vector3d(0, 0, 0.15));
  scene.objects.back().attachment = Attachment{scene.robots.front().name, "probe", {}};
  add_object(scene, "ceiling", Box{{1.0, 1.0, 0.1}}, Eigen::Vector3d(0, 0, 0.5));
  const auto checker = checker_of(scene);
  EXPECT_TRUE(checker->first_collision(Eigen::Vector3d(0, 0, 0.191)));
  EXPECT_FALSE(checker->first_collision(Eigen::Vector3d(0, 0, 0.189)));
}

TEST(Padding, GoesWithScale) {
  Scene scene = test::scene_of(test::gantry(test::as_mesh(Box{{0.1, 0.1, 0.1}})));
  scene.robots.front().padding["probe"] = {1.2, 0.01};
  add_object(scene, "wall", Box{{0.1, 1.0, 1.0}}, Eigen::Vector3d(0.5, 0.0, 0.0));
  const auto checker = checker_of(scene);
  EXPECT_TRUE(checker->first_collision(Eigen::Vector3d(0.381, 0, 0)));
  EXPECT_FALSE(checker->first_collision(Eigen::Vector3d(0.379, 0, 0)));
}

// The test covers every kind of link and object, mirrored meshes among them, at random places.
TEST(Padding, AgreesWithDistancesOfFcl) {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Mesh mirrored = std::get<Mesh>(u_shape());
  mirrored.triangles = std::make_shared<const TriangleMesh>(
      transformed(*mirrored.triangles, Pose::Identity(), Eigen::Vector3d(-1.0, 1.0, 0.7)));
  const std::vector<Shape> shapes{
      u_shape(),           mirrored,       Box{{0.1, 0.05, 0.2}}, Sphere{0.06},
      Cylinder{0.04, 0.2}, Cone{0.05, 0.1}};
  int tried = 0;
  int within = 0;
  for (const Shape& probe : shapes) {
    Scene scene = test::scene_of(test::gantry(probe));
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      add_object(scene, "thing " + std::to_string(i), shapes[i],
                 pose_from_rpy({uniform(engine), uniform(engine), uniform(engine)},
                               3.0 * uniform(engine), uniform(engine), uniform(engine)));
      scene.objects.back().solid = i != 3;
    }
    Scene padded = scene;
    const double padding = 0.03 * uniform(engine);
    padded.robots.front().padding["probe"] = {1.0, padding};
    const auto plain = checker_of(scene, CheckerKind::kFcl);
    const auto fast = checker_of(padded);
    const auto reference = checker_of(padded, CheckerKind::kFcl);
    for (int i = 0; i < test::scaled(400); ++i, ++tried) {
      const Configuration q = Eigen::Vector3d(uniform(engine), uniform(engine), uniform(engine));
      plain->place(q);
      fast->place(q);
      reference->place(q);
      bool any = false;
      for (int pair = 0; pair < static_cast<int>(plain->world().pairs().size()); ++pair) {
        const double distance = plain->pair_distance(pair, 1.0);
        if (std::abs(distance - padding) < 1e-9) {
          continue;
        }
        const bool collides = distance < padding;
        within += collides && distance > 0.0 ? 1 : 0;
        any = any || collides;
        ASSERT_EQ(fast->pair_collides(pair), collides) << distance << " of " << padding;
        ASSERT_EQ(reference->pair_collides(pair), collides) << distance << " of " << padding;
        ASSERT_NEAR(fast->pair_distance(pair, 0.5),
                    std::min(0.5, std::max(0.0, distance - padding)), 1e-6);
        ASSERT_LE(fast->pair_bound(pair, 0.5), std::max(0.0, distance - padding) + 1e-6);
      }
      ASSERT_EQ(fast->first_collision(q).has_value(), any);
    }
  }
  std::cout << tried << " configurations, " << within << " pairs within their padding alone\n";
  EXPECT_GT(within, tried / 50);
}

}  // namespace
}  // namespace handway::geometric
