#include "handway/planning/timing/time_parameterization.h"

#include "handway/planning/timing/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

namespace handway::planning {
namespace {

using Eigen::Vector2d;
using Eigen::Vector4d;

JointKinematicLimits rate_limits(const Eigen::VectorXd& velocity,
                                 const Eigen::VectorXd& acceleration) {
  return {velocity, acceleration};
}

BlendedPath blended(const Path& path, double deviation) {
  return {path, std::vector<double>(path.waypoints.size(), deviation)};
}

double duration(const Path& path, double deviation, const JointKinematicLimits& rates) {
  return time_optimal(blended(path, deviation), rates).duration();
}

/// Largest share of a limit that the motion reaches, between knots too.
double largest_share(const BlendedPath& path, const TimeParameterization& law,
                     const JointKinematicLimits& rates) {
  double share = 0.0;
  constexpr int kSamples = 20000;
  for (int i = 1; i < kSamples; ++i) {
    const TrajectoryPoint point = point_at(path, law, law.duration() * i / kSamples);
    share = std::max(share, point.velocity.cwiseAbs().cwiseQuotient(rates.velocity).maxCoeff());
    share =
        std::max(share, point.acceleration.cwiseAbs().cwiseQuotient(rates.acceleration).maxCoeff());
  }
  return share;
}

// Closed forms: a triangle of speed, and a trapezium.
TEST(TimeParameterization, TakesAStraightLineAsFastAsThereIs) {
  const JointKinematicLimits rates = rate_limits(Vector2d(2, 10), Vector2d(1, 10));
  EXPECT_NEAR(duration({{Vector2d(0, 0), Vector2d(1, 1)}}, 0, rates), 2.0, 1e-5);
  EXPECT_NEAR(duration({{Vector2d(0, 0), Vector2d(10, 1)}}, 0, rates), 10 / 2.0 + 2, 1e-5);
}

TEST(TimeParameterization, AddsUpStraightLinesWhereItStops) {
  const JointKinematicLimits rates = rate_limits(Vector2d(2, 2), Vector2d(1, 1));
  EXPECT_NEAR(duration({{Vector2d(0, 0), Vector2d(1, 0), Vector2d(1, 1)}}, 0, rates), 4.0, 1e-5);
}

TEST(TimeParameterization, PassesWaypointsOnALineWithoutSlowingDown) {
  const JointKinematicLimits rates = rate_limits(Vector2d(2, 2), Vector2d(1, 1));
  EXPECT_NEAR(duration({{Vector2d(0, 0), Vector2d(0.3, 0.3), Vector2d(1, 1)}}, 0, rates), 2.0,
              1e-4);
}

// Waypoints, rate_limits and durations of the tests that Kunz and Stilman's own
// implementation (2012) comes with, in encoder counts. Theirs steps through
// the phase plane in fixed times; the durations are of steps of 10 and 0.001 s.
TEST(TimeParameterization, AgreesWithTheAuthorsImplementation) {
  const Path line = {{Vector4d(1424.0, 984.999694824219, 2126.0, 0.0),
                      Vector4d(1423.0, 985.000244140625, 2126.0, 0.0)}};
  const Eigen::VectorXd velocity = Vector4d(1.3, 0.67, 0.67, 0.5);
  EXPECT_NEAR(duration(line, 100.0, rate_limits(velocity, Vector4d::Constant(0.00249))),
              40.080256821829849, 1e-3);
  const Path path = {{Vector4d(1427.0, 368.0, 690.0, 90.0), Vector4d(1427.0, 368.0, 790.0, 90.0),
                      Vector4d(952.499938964844, 433.0, 1051.0, 90.0),
                      Vector4d(452.5, 533.0, 1051.0, 90.0), Vector4d(452.5, 533.0, 951.0, 90.0)}};
  const double took = duration(path, 100.0, rate_limits(velocity, Vector4d::Constant(0.002)));
  EXPECT_NEAR(took, 1919.5597888812974, 1.0);
  EXPECT_LT(took, 1922.1418427445944);
}

TEST(TimeParameterization, IsFasterWithArcsThanWithStops) {
  const Path path = {{Vector2d(0, 0), Vector2d(1, 0), Vector2d(1, 1), Vector2d(2, 1)}};
  const JointKinematicLimits rates = rate_limits(Vector2d(2, 2), Vector2d(4, 4));
  double last = duration(path, 0.0, rates);
  for (const double deviation : {0.001, 0.01, 0.05, 0.1}) {
    const double took = duration(path, deviation, rates);
    EXPECT_LT(took, last) << deviation;
    last = took;
  }
  EXPECT_GE(last, least_duration(path, rates));
}

TEST(TimeParameterization, NeverExceedsALimitOnAnyOfManyPaths) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  for (int run = 0; run < 30; ++run) {
    Path path;
    const int joints = 1 + run % 7;
    for (int w = 0; w < 2 + run % 5; ++w) {
      path.waypoints.emplace_back(
          Eigen::VectorXd::NullaryExpr(joints, [&] { return value(random); }));
    }
    JointKinematicLimits rates;
    rates.velocity = Eigen::VectorXd::NullaryExpr(joints, [&] { return 2.0 + value(random); });
    rates.acceleration =
        Eigen::VectorXd::NullaryExpr(joints, [&] { return 6.0 + 4 * value(random); });
    const BlendedPath smooth = blended(path, 0.02 * (run % 4));
    const TimeParameterization law = time_optimal(smooth, rates);
    const double share = largest_share(smooth, law, rates);
    EXPECT_LT(share, 1.0 + 1e-4) << run;
    EXPECT_GT(share, 0.95) << run << ": something has to be at its limit";
    if (run % 4 == 0) {  // through the waypoints
      EXPECT_GE(law.duration(), (1 - 1e-4) * least_duration(path, rates)) << run;
    }
  }
}

TEST(TimeParameterization, RunsTheSameMotionSlower) {
  const Path path = {{Vector2d(0, 0), Vector2d(1, 0), Vector2d(1, 1)}};
  const JointKinematicLimits rates = rate_limits(Vector2d(2, 2), Vector2d(4, 4));
  EXPECT_NEAR(duration(path, 0.1, rates.at_speed(0.25)), 4.0 * duration(path, 0.1, rates), 1e-9);
}

TEST(TimeParameterization, BringsStopsToMultiplesOfThePeriod) {
  const Path path = {{Vector2d(0, 0), Vector2d(1, 0), Vector2d(1, 0.7), Vector2d(2, 0.7)}};
  const BlendedPath corners = blended(path, 0.0);
  const TimeParameterization fast =
      time_optimal(corners, rate_limits(Vector2d(2, 2), Vector2d(4, 4)));
  const TimeParameterization law = align_stops(fast, 0.004);
  int stops = 0;
  for (std::size_t k = 0; k < law.knots.size(); ++k) {
    if (law.knots[k].speed == 0.0) {
      EXPECT_NEAR(std::remainder(law.knots[k].time, 0.004), 0.0, 1e-12);
      ++stops;
    }
    EXPECT_GE(law.knots[k].time, fast.knots[k].time - 1e-12);
    EXPECT_LE(law.knots[k].time, fast.knots[k].time + 3 * 0.004);
  }
  EXPECT_EQ(stops, 6);
  const std::vector<double> times = waypoint_times(corners, law);
  for (std::size_t w = 0; w < path.waypoints.size(); ++w) {
    EXPECT_LT((point_at(corners, law, times[w]).position - path.waypoints[w]).norm(), 1e-9) << w;
  }
}

TEST(TimeParameterization, OfAPathWithoutLengthIsEmpty) {
  const BlendedPath path = blended({{Vector2d(1, 2), Vector2d(1, 2)}}, 0.1);
  const TimeParameterization law = time_optimal(path, rate_limits(Vector2d(1, 1), Vector2d(1, 1)));
  EXPECT_EQ(law.duration(), 0.0);
  const Trajectory still = sample(path, align_stops(law, 0.01), 0.01);
  ASSERT_EQ(still.points.size(), 2U);
  EXPECT_EQ(still.points[0].position, still.points[1].position);
  EXPECT_EQ(still.points[1].time, 0.01);
}

TEST(Trajectory, BeginsAndEndsAtRestAtTheEndsOfThePath) {
  const Path path = {{Vector2d(0.1, 0.2), Vector2d(1, 0), Vector2d(1.1, 1.3)}};
  const BlendedPath smooth = blended(path, 0.1);
  const TimeParameterization law =
      align_stops(time_optimal(smooth, rate_limits(Vector2d(2, 2), Vector2d(4, 4))), 0.004);
  const Trajectory trajectory = sample(smooth, law, 0.004);
  EXPECT_EQ(trajectory.points.front().position, path.waypoints.front()) << "to the bit";
  EXPECT_EQ(trajectory.points.back().position, path.waypoints.back()) << "to the bit";
  EXPECT_EQ(trajectory.points.front().velocity.norm(), 0.0);
  EXPECT_EQ(trajectory.points.back().velocity.norm(), 0.0);
  for (std::size_t i = 0; i < trajectory.points.size(); ++i) {
    EXPECT_NEAR(trajectory.points[i].time, 0.004 * static_cast<double>(i), 1e-9);
  }
}

TEST(Trajectory, HasTheVelocitiesOfItsPositions) {
  const Path path = {{Vector2d(0, 0), Vector2d(1, 0), Vector2d(1, 1)}};
  const BlendedPath smooth = blended(path, 0.1);
  const TimeParameterization law =
      time_optimal(smooth, rate_limits(Vector2d(2, 2), Vector2d(4, 4)));
  const Trajectory trajectory = sample(smooth, law, 0.001);
  for (std::size_t i = 1; i + 1 < trajectory.points.size(); ++i) {
    const TrajectoryPoint& a = trajectory.points[i - 1];
    const TrajectoryPoint& b = trajectory.points[i + 1];
    const Eigen::VectorXd velocity = (b.position - a.position) / (b.time - a.time);
    EXPECT_LT((velocity - trajectory.points[i].velocity).norm(), 6e-3) << i;
  }
}

TEST(Trajectory, RefusesAPeriodThatIsNone) {
  const BlendedPath path = blended({{Vector2d(0, 0), Vector2d(1, 2)}}, 0.1);
  const TimeParameterization law = time_optimal(path, rate_limits(Vector2d(1, 1), Vector2d(1, 1)));
  EXPECT_THROW(static_cast<void>(sample(path, law, 0.0)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(sample(path, law, 1e-9)), std::invalid_argument);
}

TEST(LeastDuration, CountsEveryTurnOfAJoint) {
  const JointKinematicLimits rates = rate_limits(Vector2d(10, 10), Vector2d(1, 1));
  EXPECT_NEAR(least_duration({{Vector2d(0, 0), Vector2d(1, 0)}}, rates), 2.0, 1e-12);
  EXPECT_NEAR(least_duration({{Vector2d(0, 0), Vector2d(1, 0), Vector2d(0, 5)}}, rates), 4.472,
              1e-3);
  EXPECT_NEAR(least_duration({{Vector2d(0, 0), Vector2d(4, 0), Vector2d(0, 0)}}, rates), 8.0,
              1e-12);
}

}  // namespace
}  // namespace handway::planning
