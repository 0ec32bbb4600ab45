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

JointKinematicLimits limits(double velocity, double acceleration, double jerk) {
  return {Vector2d::Constant(velocity), Vector2d::Constant(acceleration), Vector2d::Constant(jerk)};
}

BlendedPath smooth(const Path& path, double deviation) {
  return {path, std::vector<double>(path.waypoints.size(), deviation), ArcShape::kSmooth};
}

/// Largest shares of the limits, measured: of derivatives that follow from positions alone.
struct Shares {
  double velocity = 0.0;
  double acceleration = 0.0;
  double jerk = 0.0;
};

Shares measured(const BlendedPath& path, const TimeParameterization& law,
                const JointKinematicLimits& rates) {
  constexpr int kSamples = 8000;
  const double step = law.duration() / kSamples;
  std::vector<Eigen::VectorXd> q;
  for (int i = 0; i <= kSamples; ++i) {
    q.push_back(point_at(path, law, step * i).position);
  }
  Shares shares;
  const auto keep = [](double& share, const Eigen::VectorXd& rate, const Eigen::VectorXd& limit) {
    share = std::max(share, rate.cwiseAbs().cwiseQuotient(limit).maxCoeff());
  };
  for (std::size_t i = 3; i < q.size(); ++i) {
    keep(shares.velocity, (q[i] - q[i - 1]) / step, rates.velocity);
    keep(shares.acceleration, (q[i] - 2.0 * q[i - 1] + q[i - 2]) / (step * step),
         rates.acceleration);
    keep(shares.jerk, (q[i] - 3.0 * q[i - 1] + 3.0 * q[i - 2] - q[i - 3]) / std::pow(step, 3),
         rates.jerk);
  }
  return shares;
}

TEST(SmoothArc, TurnsFromEdgeToEdgeWithoutAJumpOfCurvature) {
  const Path path = {{Vector2d(0, 0), Vector2d(1, 0), Vector2d(1.5, 1)}};
  const BlendedPath blended = smooth(path, 0.05);
  ASSERT_EQ(blended.pieces().size(), 3U);
  const PathPiece& arc = blended.pieces()[1];
  EXPECT_TRUE(arc.is_smooth_arc());
  EXPECT_NEAR((arc.derivative(0, 0.5 * arc.length) - path.waypoints[1]).norm(), 0.05, 1e-12);
  EXPECT_LT((arc.derivative(0, arc.length) - blended.pieces()[2].origin).norm(), 1e-12);
  EXPECT_LT((arc.derivative(1, arc.length) - blended.pieces()[2].tangent).norm(), 1e-12);
  EXPECT_LT(arc.derivative(2, 0.0).norm(), 1e-12);
  EXPECT_LT(arc.derivative(2, arc.length).norm(), 1e-12);
  constexpr double kStep = 1e-5;
  for (double s = kStep; s < arc.length - kStep; s += 0.1 * arc.length) {
    for (const int order : {1, 2, 3}) {
      const Eigen::VectorXd slope =
          (arc.derivative(order - 1, s + kStep) - arc.derivative(order - 1, s - kStep)) /
          (2.0 * kStep);
      EXPECT_LT((slope - arc.derivative(order, s)).norm(), order == 1 ? 1e-6 : 1e-4);
    }
    EXPECT_TRUE((arc.derivative(1, s).cwiseAbs().array() <= arc.fastest().array() + 1e-12).all());
  }
}

// If jerk alone counts, the least time for a distance d is (32 d / j)^(1/3).
TEST(JerkLimited, IsNearTheLeastTimeOfAStraightLine) {
  const BlendedPath path = smooth({{Vector2d(0, 0), Vector2d(1, 0.5)}}, 0.0);
  const double least = std::cbrt(32.0 * 1.0 / 20.0);
  const double duration = jerk_limited(path, limits(1e3, 1e3, 20.0)).duration();
  EXPECT_GT(duration, least);
  EXPECT_LT(duration, 1.3 * least);
}

TEST(JerkLimited, IsNearlyTheFastestWhereJerkHardlyCounts) {
  const BlendedPath path = smooth({{Vector2d(0, 0), Vector2d(10, 5), Vector2d(20, 0)}}, 0.2);
  const JointKinematicLimits rates = limits(2.0, 4.0, 4000.0);
  EXPECT_LT(jerk_limited(path, rates).duration(), 1.1 * time_optimal(path, rates).duration());
}

TEST(JerkLimited, KeepsAllLimitsAlongRandomPaths) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  for (int run = 0; run < 16; ++run) {
    Path path;
    const int joints = 1 + run % 7;
    const auto numbers = [&](double middle, double spread) -> Eigen::VectorXd {
      return Eigen::VectorXd::NullaryExpr(joints, [&] { return middle + spread * value(random); });
    };
    for (int w = 0; w < 2 + run % 5; ++w) {
      path.waypoints.push_back(numbers(0.0, 1.0));
    }
    const JointKinematicLimits rates{numbers(2.0, 1.0), numbers(6.0, 4.0), numbers(60.0, 40.0)};
    const BlendedPath blended = smooth(path, 0.02 * (run % 4));
    const TimeParameterization law = align_stops(jerk_limited(blended, rates), 0.004);
    const Shares shares = measured(blended, law, rates);
    EXPECT_LT(shares.velocity, 1.0 + 1e-6) << run;
    EXPECT_LT(shares.acceleration, 1.0 + 1e-4) << run;
    EXPECT_LT(shares.jerk, 1.0 + 1e-3) << run;
    EXPECT_GT(std::max({shares.velocity, shares.acceleration, shares.jerk}), 0.9) << run;
    EXPECT_GT(law.duration(), time_optimal(blended, rates).duration()) << run;
  }
}

TEST(JerkLimited, StopsWhereThereIsNoArcAndEndsAtTheEnds) {
  const Path path = {{Vector2d(0, 0), Vector2d(1, 0), Vector2d(1, 0.7), Vector2d(2, 0.7)}};
  const BlendedPath corners = smooth(path, 0.0);
  const TimeParameterization law = align_stops(jerk_limited(corners, limits(2, 4, 40)), 0.004);
  const std::vector<double> times = waypoint_times(corners, law);
  for (std::size_t w = 0; w < path.waypoints.size(); ++w) {
    const TrajectoryPoint point = point_at(corners, law, times[w]);
    EXPECT_LT((point.position - path.waypoints[w]).norm(), 1e-9) << w;
    EXPECT_LT(point.velocity.norm(), 1e-6) << w;
    EXPECT_LT(point.acceleration.norm(), 1e-3) << w;
  }
}

TEST(JerkLimited, RefusesCircularArcs) {
  const Path path = {{Vector2d(0, 0), Vector2d(1, 0), Vector2d(1, 0.7)}};
  const BlendedPath circular(path, {0.0, 0.1, 0.0});
  EXPECT_THROW(static_cast<void>(jerk_limited(circular, limits(2, 4, 40))), std::invalid_argument);
}

TEST(JerkLimited, OfAPathWithoutLengthIsEmpty) {
  const BlendedPath path = smooth({{Vector2d(1, 2), Vector2d(1, 2)}}, 0.1);
  EXPECT_EQ(jerk_limited(path, limits(1, 1, 1)).duration(), 0.0);
}

}  // namespace
}  // namespace handway::planning
