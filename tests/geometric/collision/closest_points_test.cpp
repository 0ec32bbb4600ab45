#include "handway/geometric/collision/narrow_phase/closest_points.h"

#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway_test/solid_robots.h"

#include <gtest/gtest.h>

#include <cmath>

namespace handway::geometric {
namespace {

using test::add_object;
using test::scene_of;

/// Returns the closest points of a box of 0.2 m at `p` and one of 0.4 m at the origin, turned by
/// `yaw`.
std::optional<ClosestPoints> closest_to_box(const Eigen::Vector3d& p, double yaw = 0.0) {
  Scene scene = scene_of(test::gantry(Box{{0.2, 0.2, 0.2}}));
  add_object(scene, "box", Box{{0.4, 0.4, 0.4}},
             pose_from_rpy(Eigen::Vector3d::Zero(), 0.0, 0.0, yaw));
  ClosestPointFinder finder(std::make_shared<const CollisionWorld>(scene));
  return finder.between("probe", "box", p);
}

TEST(ClosestPoints, LieOnTheFacesThatAreClosest) {
  const auto points = closest_to_box({0.45, 0.02, 0.03});
  ASSERT_TRUE(points);
  EXPECT_NEAR(points->p_WA.x(), 0.35, 1e-9);
  EXPECT_NEAR(points->p_WB.x(), 0.20, 1e-9);
  EXPECT_NEAR((points->p_WA - points->p_WB).norm(), 0.15, 1e-9);
}

TEST(ClosestPoints, AreInTheWorldWhereverTheBodiesAre) {
  const auto points = closest_to_box({0.5, 0.5, 0.5});
  ASSERT_TRUE(points);
  EXPECT_TRUE(points->p_WA.isApprox(Eigen::Vector3d(0.4, 0.4, 0.4), 1e-9));
  EXPECT_TRUE(points->p_WB.isApprox(Eigen::Vector3d(0.2, 0.2, 0.2), 1e-9));
}

TEST(ClosestPoints, FollowATurnedBody) {
  const auto points = closest_to_box({0.6, 0.0, 0.0}, 0.25 * std::acos(-1.0));
  ASSERT_TRUE(points);
  EXPECT_NEAR(points->p_WA.x(), 0.5, 1e-9);
  EXPECT_NEAR(points->p_WB.x(), 0.2 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(points->p_WB.y(), 0.0, 1e-9);
}

TEST(ClosestPoints, AreNoneOfWhatTouchesOrIsNotThere) {
  EXPECT_FALSE(closest_to_box({0.25, 0.0, 0.0}));
  Scene scene = scene_of(test::gantry(Sphere{0.1}));
  ClosestPointFinder finder(std::make_shared<const CollisionWorld>(scene));
  EXPECT_FALSE(finder.between("probe", "nothing", Eigen::Vector3d::Zero()));
}

TEST(ClosestPoints, AreAsFarApartAsFclMeasures) {
  Scene scene = scene_of(test::gantry(Cylinder{0.1, 0.3}));
  add_object(scene, "ball", Sphere{0.15}, Pose::Identity());
  const auto world = std::make_shared<const CollisionWorld>(scene);
  const int pair = world->pairs_with("ball").front();
  ClosestPointFinder finder(world);
  FclChecker checker(world);
  int apart = 0;
  for (const double x : {-0.5, -0.3, -0.26, 0.1, 0.27, 0.8}) {
    for (const double z : {-0.4, -0.31, 0.05, 0.302, 0.5}) {
      const Configuration q = Eigen::Vector3d(x, 0.07, z);
      checker.place(q);
      const double distance = checker.pair_distance(pair, 10.0);
      const auto points = finder.between("probe", "ball", q);
      ASSERT_EQ(points.has_value(), distance > 0.0) << q.transpose();
      if (points) {
        ++apart;
        EXPECT_NEAR((points->p_WA - points->p_WB).norm(), distance, 1e-9) << q.transpose();
      }
    }
  }
  EXPECT_GT(apart, 20);
}

TEST(ClosestPoints, AreLookedForAsFarAsIsEnough) {
  Scene scene = scene_of(test::gantry(Box{{0.2, 0.2, 0.2}}));
  add_object(scene, "box", Box{{0.4, 0.4, 0.4}}, Pose::Identity());
  const auto world = std::make_shared<const CollisionWorld>(scene);
  const auto [probe, box] =
      world->pairs()[static_cast<std::size_t>(world->pairs_with("box").front())];
  ClosestPointFinder finder(world);
  const Pose X_WProbe = Pose(Eigen::Translation3d(0.45, 0.02, 0.03));  // 0.15 m from the box
  const auto points = finder.between(probe, box, X_WProbe, Pose::Identity(), 0.151);
  ASSERT_TRUE(points);
  EXPECT_NEAR((points->p_WA - points->p_WB).norm(), 0.15, 1e-9);
  EXPECT_FALSE(finder.between(probe, box, X_WProbe, Pose::Identity(), 0.149));
}

}  // namespace
}  // namespace handway::geometric
