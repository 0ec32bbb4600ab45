#include "handway/sampling/regions/arm_corridor.h"
#include "handway/sampling/sequences/random_stream.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace handway::sampling {
namespace {

using geometric::Pose;

const Eigen::VectorXd kMiddle = Eigen::VectorXd::Constant(6, 0.5);

Pose start() { return geometric::pose_from_rpy({0.5, -0.2, 0.4}, 0.1, 0.2, 0.3); }

// One metre on along x, a quarter turn about the tool's own z axis.
Pose goal() {
  Pose X = start();
  X.translation().x() += 1.0;
  X.rotate(Eigen::AngleAxisd(std::numbers::pi / 2.0, Eigen::Vector3d::UnitZ()));
  return X;
}

TEST(CartesianCorridor, StartsAndEndsAtTheGivenPoses) {
  const CartesianCorridor corridor(start(), goal());
  EXPECT_TRUE(corridor.pose(0.0, 0.1, kMiddle).isApprox(start(), 1e-12));
  EXPECT_TRUE(corridor.pose(1.0, 0.1, kMiddle).isApprox(goal(), 1e-12));
}

TEST(CartesianCorridor, MovesStraightAndTurnsEvenly) {
  const CartesianCorridor corridor(start(), goal());
  Pose expected = start();
  expected.translation().x() += 0.25;
  expected.rotate(Eigen::AngleAxisd(std::numbers::pi / 8.0, Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE(corridor.pose(0.25, 0.0, kMiddle).isApprox(expected, 1e-12));
}

TEST(CartesianCorridor, PerturbsPositionAndOrientationByTheirScales) {
  const CartesianCorridor corridor(start(), goal(), {0.5, 2.0});
  Eigen::VectorXd u = kMiddle;
  u[1] = 1.0;  // + rho · 0.5 m along y
  u[3] = 0.0;  // - rho · 2 rad about the tool's x
  const Pose X_BT = corridor.pose(0.0, 0.1, u);
  EXPECT_LT((X_BT.translation() - start().translation() - Eigen::Vector3d(0, 0.05, 0)).norm(),
            1e-12);
  const Eigen::Matrix3d expected =
      start().linear() * Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitX());
  EXPECT_TRUE(X_BT.linear().isApprox(expected, 1e-12));
}

TEST(CartesianCorridor, StaysWithinTheCubes) {
  constexpr double kRho = 0.2;
  const CartesianCorridor corridor(start(), goal(), {0.5, 1.5});
  RandomStream stream(1);
  for (int i = 0; i < 500; ++i) {
    const double step = stream.uniform();
    const Pose X_centre = corridor.pose(step, 0.0, kMiddle);
    const Pose X_BT = corridor.pose(step, kRho, stream.uniform(6));
    const Eigen::Vector3d offset = X_BT.translation() - X_centre.translation();
    EXPECT_LE(offset.lpNorm<Eigen::Infinity>(), kRho * 0.5 + 1e-12);
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(X_centre.linear().transpose() * X_BT.linear()));
    const Eigen::Vector3d rotation_vector = turn.angle() * turn.axis();
    EXPECT_LE(rotation_vector.lpNorm<Eigen::Infinity>(), kRho * 1.5 + 1e-9);
    EXPECT_TRUE((X_BT.linear() * X_BT.linear().transpose()).isIdentity(1e-12));
  }
}

TEST(CartesianCorridor, SpacesItsStepsByRho) {
  const CartesianCorridor by_way(start(), goal(), {1.0, std::numbers::pi});
  EXPECT_NEAR(by_way.length(), 1.0, 1e-12);
  EXPECT_EQ(by_way.steps(0.3), 4);
  const CartesianCorridor by_turn(start(), goal(), {1.0, std::numbers::pi / 8.0});
  EXPECT_NEAR(by_turn.length(), 4.0, 1e-12);
  EXPECT_EQ(by_turn.steps(0.3), 16);
}

TEST(CartesianCorridor, RefusesWrongArguments) {
  EXPECT_THROW(CartesianCorridor(start(), goal(), {0.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(CartesianCorridor(start(), goal(), {1.0, NAN}), std::invalid_argument);
  const CartesianCorridor corridor(start(), goal());
  EXPECT_THROW(static_cast<void>(corridor.pose(0.0, 0.1, Eigen::VectorXd::Zero(3))),
               std::invalid_argument);
}

}  // namespace
}  // namespace handway::sampling
