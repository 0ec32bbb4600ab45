#include "handway/planning/timing/joint_moves.h"

#include "handway_test/motions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace handway::planning {
namespace {

/// Duration of a move by `distance` with a trapezium of speed, by integration, s.
double integrated_duration(double distance, double velocity, double acceleration) {
  constexpr double kStep = 1e-6;
  double time = 0.0;
  double speed = 0.0;
  for (double x = 0.0; x < 0.5 * distance; x += speed * kStep) {
    speed = std::min(speed + acceleration * kStep, velocity);
    time += kStep;
  }
  return 2.0 * time;
}

JointMove a_move(double duration) {
  return {.target = Eigen::VectorXd::Zero(1),
          .duration = duration,
          .largest_change = 1.0,
          .velocity_limit = 2.0,
          .acceleration_limit = 8.0};
}

TEST(JointMove, TakesItsDurationAtItsVelocityShare) {
  for (const double duration : {0.8, 1.0, 3.0}) {
    const JointMove move = a_move(duration);
    for (const double acceleration : {1.0, 0.9}) {
      const double velocity = move.velocity_share(acceleration);
      EXPECT_NEAR(move.duration_at(velocity, acceleration), duration, 1e-9);
      EXPECT_NEAR(integrated_duration(1.0, velocity * 2.0, acceleration * 8.0), duration, 1e-4);
    }
  }
}

TEST(JointMove, IsATriangleOfSpeedIfItIsShort) {
  const JointMove move = a_move(1.0);
  EXPECT_NEAR(move.duration_at(100.0, 0.5), 1.0, 1e-9) << "2 / sqrt(4)";
  EXPECT_NEAR(integrated_duration(1.0, 200.0, 4.0), 1.0, 1e-4);
}

TEST(JointMove, HasNoVelocityIfTheAccelerationIsTooLow) {
  EXPECT_TRUE(std::isinf(a_move(0.5).velocity_share(0.5)));
}

TEST(JointMoves, GoFromWaypointToWaypoint) {
  const Motion motion = test::tx90_sah_motion(false, 0.5);
  const std::vector<JointMove> moves = joint_moves(motion);
  ASSERT_EQ(moves.size(), 3U);
  for (std::size_t i = 0; i < moves.size(); ++i) {
    EXPECT_EQ(moves[i].target, motion.path.waypoints[i + 1](motion.arm));
    EXPECT_DOUBLE_EQ(moves[i].duration, motion.waypoint_times[i + 1] - motion.waypoint_times[i]);
    EXPECT_EQ(moves[i].waits, i == 1) << "the hand moves alone";
  }
  EXPECT_NEAR(moves[0].largest_change, 0.4, 1e-12) << "joint_1";
  EXPECT_NEAR(moves[0].velocity_limit, motion.limits.velocity[motion.arm[0]] / 0.4, 1e-9);
}

}  // namespace
}  // namespace handway::planning
