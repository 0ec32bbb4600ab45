#include "handway/planning/queries/dynamic_time_warping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace handway::planning {
namespace {

// A straight motion of two joints through `points` points, at rising speed for an exponent above 1.
Eigen::MatrixXd straight(Eigen::Index points, double exponent = 1.0, double beside = 0.0) {
  Eigen::MatrixXd motion(points, 2);
  motion.col(0) = Eigen::ArrayXd::LinSpaced(points, 0.0, 1.0).pow(exponent);
  motion.col(1).setConstant(beside);
  return motion;
}

TEST(WarpedDistance, IsZeroForTheSameMotion) {
  EXPECT_EQ(warped_distance(straight(50), straight(50)), 0.0);
}

TEST(WarpedDistance, IgnoresThatOneMotionPauses) {
  Eigen::MatrixXd paused(60, 2);
  paused << straight(50).topRows(20), straight(50).row(19).replicate(10, 1),
      straight(50).bottomRows(30);
  EXPECT_EQ(warped_distance(straight(50), paused), 0.0);
}

TEST(WarpedDistance, HardlyCountsOtherSpeeds) {
  const Eigen::MatrixXd late = straight(50, 3.0);
  const double pointwise = (straight(50) - late).rowwise().norm().mean();
  EXPECT_LT(warped_distance(straight(50), late), 0.1 * pointwise);
}

TEST(WarpedDistance, IsTheDistanceOfParallelMotions) {
  EXPECT_NEAR(warped_distance(straight(50), straight(50, 1.0, 0.3)), 0.3, 1e-12);
}

TEST(WarpedDistance, IsSymmetric) {
  const Eigen::MatrixXd a = straight(50, 2.0);
  const Eigen::MatrixXd b = straight(40, 0.7, 0.1);
  EXPECT_NEAR(warped_distance(a, b), warped_distance(b, a), 1e-12);
}

TEST(WarpedDistance, MatchesByHand) {
  // (0 1) with (0 0 1): the first point is matched twice, at no cost.
  const Eigen::Vector2d a(0.0, 1.0);
  EXPECT_EQ(warped_distance(a, Eigen::Vector3d(0.0, 0.0, 1.0)), 0.0);
  // (0 1) with (0 3): the ends are 2 apart, which a diagonal step counts twice, of 4 points; a step
  // along one motion and then along the other costs 1 + 2 or 3 + 2.
  EXPECT_NEAR(warped_distance(a, Eigen::Vector2d(0.0, 3.0)), 3.0 / 4.0, 1e-12);
}

TEST(WarpedDistance, WantsPointsOfTheSameJoints) {
  EXPECT_THROW(static_cast<void>(warped_distance(straight(5), Eigen::MatrixXd::Zero(5, 3))),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(warped_distance(Eigen::MatrixXd(0, 2), straight(5))),
               std::invalid_argument);
}

TEST(MotionSpread, IsTheMedianOfAllPairs) {
  const auto spread = motion_spread({straight(50), straight(50, 1.0, 0.1), straight(50, 1.0, 0.4)});
  ASSERT_TRUE(spread);
  EXPECT_EQ(spread->motions, 3U);
  EXPECT_NEAR(spread->median, 0.3, 1e-12);
  EXPECT_NEAR(spread->largest, 0.4, 1e-12);
}

TEST(MotionSpread, NeedsTwoMotions) {
  EXPECT_FALSE(motion_spread({}));
  EXPECT_FALSE(motion_spread({straight(50)}));
}

TEST(MotionSpread, ComparesTheFirstFortyOfMany) {
  const std::vector<Eigen::MatrixXd> many(100, straight(5));
  EXPECT_EQ(motion_spread(many)->motions, 40U);
}

}  // namespace
}  // namespace handway::planning
