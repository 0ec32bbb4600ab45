#include "handway/geometric/collision/continuous/sliding_step.h"

#include "handway/geometric/collision/checkers/exact_collision_checker.h"
#include "handway_test/solid_robots.h"

#include <gtest/gtest.h>

namespace handway::geometric {
namespace {

constexpr double kResolution = 0.01;

// A ball of 5 cm radius that three sliding joints carry, and a wall across x at 0.5 m.
class BallAndWall : public testing::Test {
 protected:
  BallAndWall() {
    Scene scene = test::scene_of(test::gantry(Sphere{0.05}));
    test::add_object(scene, "wall", Box{{0.1, 4.0, 4.0}}, Eigen::Vector3d(0.55, 0.0, 0.0));
    scene_ = std::make_shared<const Scene>(std::move(scene));
    checker_ = make_collision_checker(std::make_shared<const CollisionWorld>(*scene_));
  }

  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<CollisionChecker> checker_;
};

TEST_F(BallAndWall, GoesTheWholeWayThatIsFree) {
  const Configuration to = Eigen::Vector3d(0.4, -0.3, 0.2);
  const FreeStep step = sliding_step(*checker_, Eigen::Vector3d::Zero(), to, {}, kResolution);
  EXPECT_EQ(step.q, to);
  EXPECT_FALSE(step.pair);
}

TEST_F(BallAndWall, StopsStraightInFrontOfTheWall) {
  const FreeStep step = straight_step(*checker_, Eigen::Vector3d::Zero(),
                                      Eigen::Vector3d(0.9, 0.9, 0.0), kResolution);
  EXPECT_TRUE(step.pair);
  EXPECT_NEAR(step.q[0], 0.45, 0.001);
  EXPECT_NEAR(step.q[1], 0.45, 0.001);
  EXPECT_FALSE(checker_->first_collision(step.q));
}

TEST_F(BallAndWall, SlidesAlongTheWall) {
  const FreeStep step = sliding_step(*checker_, Eigen::Vector3d::Zero(),
                                     Eigen::Vector3d(0.9, 0.8, -0.3), {}, kResolution);
  EXPECT_TRUE(step.pair);
  EXPECT_NEAR(step.q[0], 0.45, 0.001);
  EXPECT_EQ(step.q[1], 0.8);
  EXPECT_EQ(step.q[2], -0.3);
  EXPECT_FALSE(checker_->first_collision(step.q));
}

TEST_F(BallAndWall, DoesNotJumpThroughTheWall) {
  const Configuration behind = Eigen::Vector3d(0.75, 0.0, 0.0);
  ASSERT_FALSE(checker_->first_collision(behind));
  const FreeStep step = sliding_step(*checker_, Eigen::Vector3d::Zero(), behind, {}, kResolution);
  EXPECT_NEAR(step.q[0], 0.45, 0.001);
}

TEST_F(BallAndWall, MovesAGroupTogetherBeforeItsVariables) {
  // y and z belong together: a bar stops both in front of it, and only then each alone.
  Scene scene = *scene_;
  test::add_object(scene, "bar", Box{{4.0, 0.1, 0.5}}, Eigen::Vector3d(0.0, 0.55, 0.35));
  const auto checker = make_collision_checker(std::make_shared<const CollisionWorld>(scene));
  const std::vector<std::vector<int>> groups{{1, 2}};
  const FreeStep step = sliding_step(*checker, Eigen::Vector3d::Zero(),
                                     Eigen::Vector3d(0.9, 0.8, 0.8), groups, kResolution);
  EXPECT_NEAR(step.q[1], 0.45, 0.005);
  EXPECT_EQ(step.q[2], 0.8);
}

TEST_F(BallAndWall, CanBeLedOutOfTheWall) {
  const Eigen::Vector3d inside(0.5, 0.0, 0.0);
  const Eigen::Vector3d outside(0.3, 0.1, 0.0);
  EXPECT_EQ(sliding_step(*checker_, inside, outside, {}).q, Configuration(outside));
  const FreeStep stuck = sliding_step(*checker_, inside, Eigen::Vector3d(0.52, 0.0, 0.0), {});
  EXPECT_EQ(stuck.q, Configuration(inside));
  EXPECT_TRUE(stuck.pair);
}

}  // namespace
}  // namespace handway::geometric
