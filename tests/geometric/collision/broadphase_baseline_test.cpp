/// The baseline of the benchmarks answers as FCL without a broad phase does.
#include "../robot/random_configurations.h"
#include "handway/geometric/collision/checkers/fcl_checker.h"
#include "handway_test/solid_robots.h"

#include <gtest/gtest.h>

#include <memory>

namespace handway::geometric {
namespace {

TEST(FclBroadphaseChecker, AnswersAsFclDoesOneAfterTheOther) {
  Scene scene = test::scene_of(test::solid_tx90_sah());
  test::add_object(scene, "table", Box{{0.6, 1.0, 0.05}}, Eigen::Vector3d(0.8, 0, 0.5));
  test::add_object(scene, "pole", Cylinder{0.03, 1.5}, Eigen::Vector3d(-0.4, 0.3, 0.75));
  const auto world = std::make_shared<const CollisionWorld>(scene);
  FclChecker exact(world);
  FclBroadphaseChecker baseline(world);
  const std::unique_ptr<CollisionChecker> clone = baseline.clone();
  test::RandomConfigurations random(world->model(), 41);
  int collisions = 0;
  constexpr int kConfigurations = 400;
  for (int i = 0; i < kConfigurations; ++i) {
    const Configuration q = random.next();
    const bool expected = exact.first_collision(q).has_value();
    collisions += expected ? 1 : 0;
    for (CollisionChecker* checker : {static_cast<CollisionChecker*>(&baseline), clone.get()}) {
      const std::optional<int> found = checker->first_collision(q);
      ASSERT_EQ(found.has_value(), expected) << q.transpose();
      ASSERT_TRUE(!found || exact.pair_collides(*found)) << "names a pair that touches";
    }
  }
  EXPECT_GT(collisions, kConfigurations / 10);
  EXPECT_LT(collisions, kConfigurations);
}

}  // namespace
}  // namespace handway::geometric
