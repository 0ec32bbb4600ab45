#include "handway/sampling/regions/arm_corridor.h"

#include "handway/sampling/sequences/random_stream.h"

#include <gtest/gtest.h>

namespace handway::sampling {
namespace {

const Eigen::Vector3d kStart(0.2, 0.5, 0.9);
const Eigen::Vector3d kGoal(0.8, 0.5, 0.1);

TEST(ArmCorridor, CentresItsCubesOnTheSegment) {
  const ArmCorridor corridor(kStart, kGoal);
  const Eigen::VectorXd middle = Eigen::VectorXd::Constant(3, 0.5);
  EXPECT_EQ(corridor.dimension(), 3);
  EXPECT_NEAR(corridor.length(), 1.0, 1e-15);
  EXPECT_LT((corridor.sample(0.0, 0.1, middle) - kStart).norm(), 1e-15);
  EXPECT_LT((corridor.sample(1.0, 0.1, middle) - kGoal).norm(), 1e-15);
  EXPECT_LT((corridor.sample(0.25, 0.1, middle) - Eigen::Vector3d(0.35, 0.5, 0.7)).norm(), 1e-15);
}

TEST(ArmCorridor, ReachesTheFacesOfItsCubes) {
  const ArmCorridor corridor(kStart, kGoal);
  const Eigen::VectorXd sample = corridor.sample(0.5, 0.1, Eigen::Vector3d(0, 0.5, 1));
  EXPECT_LT((sample - Eigen::Vector3d(0.4, 0.5, 0.6)).norm(), 1e-15);
}

TEST(CorridorSteps, AreTheSmallestPowerOfTwoThatIsFineEnough) {
  EXPECT_EQ(corridor_steps(1.0, 1.0), 1);
  EXPECT_EQ(corridor_steps(1.0, 0.9), 2);
  EXPECT_EQ(corridor_steps(1.0, 0.25), 4);
  EXPECT_EQ(corridor_steps(1.0, 0.2), 8);
  EXPECT_EQ(corridor_steps(0.0, 0.1), 1);
  EXPECT_EQ(corridor_steps(1.0, 0.0), 1 << 20);
  EXPECT_EQ(ArmCorridor(kStart, kGoal).steps(0.3), 4);
}

}  // namespace
}  // namespace handway::sampling
