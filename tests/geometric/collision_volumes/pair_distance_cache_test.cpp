#include "collision/cache/self_distance_cache.h"
#include "handway_test/solid_robots.h"

#include <gtest/gtest.h>

#include <vector>

namespace handway::geometric {
namespace {

constexpr int kShoulder = 0;
constexpr int kThumb = 2;

/// Table of the planar robot's thumb and palm.
struct ThumbTable {
  CollisionWorld world{handway::test::scene_of(handway::test::planar_hand_arm())};
  MotionBound motion{world};
  const RobotModel& model = world.model();
  std::unique_ptr<PairDistanceCache> table = PairDistanceCache::make(
      model, *model.find_link("palm"), *model.find_link("thumb"), 0, motion);
};

TEST(PairDistanceCache, AsksForTheSameConfigurationWhoeverAsksFirst) {
  std::vector<Configuration> asked;
  for (const double shoulder : {-1.3, 0.7}) {
    const ThumbTable thumb;
    ASSERT_EQ(thumb.model.variable(kShoulder).name, "shoulder");
    ASSERT_EQ(thumb.model.variable(kThumb).name, "thumb");
    Configuration q = thumb.model.neutral();
    q[kShoulder] = shoulder;
    q[kThumb] = 0.3011 + 1e-5 * shoulder;  // in one cell
    static_cast<void>(thumb.table->bound(q, [&](const Configuration& at) {
      asked.push_back(at);
      return 0.001;
    }));
  }
  ASSERT_EQ(asked.size(), 2U);
  EXPECT_EQ(asked[0], asked[1]) << "to the last bit";
}

TEST(PairDistanceCache, IsFilledWithPosesThatDoNotDependOnWhereTheRobotStands) {
  Scene scene = handway::test::scene_of(handway::test::planar_hand_arm());
  const CollisionWorld here(scene);
  scene.robots.front().X_WB = pose_from_rpy({100.3, -7.1, 0.9}, 0.3, 0.7, -2.1);
  const CollisionWorld there(scene);
  const Configuration q = 0.3 * (here.model().lower() + 2.0 * here.model().upper());
  const std::vector<Pose> X_BBody = poses_at_base(here, q);
  const std::vector<Pose> moved = poses_at_base(there, q);
  for (std::size_t i = 0; i < X_BBody.size(); ++i) {
    EXPECT_EQ(X_BBody[i].matrix(), moved[i].matrix()) << here.bodies()[i].name;
  }
}

}  // namespace
}  // namespace handway::geometric
