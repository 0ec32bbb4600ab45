#include "handway/planning/paths/roadmap_smoothing.h"
#include "handway_test/planar_problems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stop_token>
#include <string>
#include <utility>

namespace handway::planning {
namespace {

using test::planar_configuration;

double path_length(const PlanningProblem& problem, const Path& path) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < path.waypoints.size(); ++i) {
    sum += normalised_distance(problem.model(), path.waypoints[i], path.waypoints[i + 1]);
  }
  return sum;
}

/// A free random walk from the start with `steps` stretches of up to `reach` of a joint's range.
Path walk(PlanningContext& context, const PlanningProblem& problem, int steps, double reach,
          std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(-reach, reach);
  Path path{{problem.start}};
  while (static_cast<int>(path.waypoints.size()) <= steps) {
    Configuration next = path.waypoints.back();
    for (int v = 0; v < next.size(); ++v) {
      const double range = problem.model().upper()[v] - problem.model().lower()[v];
      next[v] = std::clamp(next[v] + share(random) * range, problem.model().lower()[v],
                           problem.model().upper()[v]);
    }
    if (!context.validator().collision(next) &&
        context.validator().edge_free(path.waypoints.back(), next)) {
      path.waypoints.push_back(next);
    }
  }
  return path;
}

/// A free random walk, then back and on to the goal.
Path wandering(PlanningContext& context, const PlanningProblem& problem, int steps) {
  Path path = walk(context, problem, steps, 0.1, 9);
  for (int i = steps - 1; i >= 0; --i) {
    path.waypoints.push_back(path.waypoints[static_cast<std::size_t>(i)]);
  }
  for (const Configuration& q : {planar_configuration(-0.4, 0, 0, 1.5, 1.5),
                                 planar_configuration(0.4, 0, 0, 1.5, 1.5), problem.goal}) {
    path.waypoints.push_back(q);
  }
  return path;
}

class Smoothing : public testing::Test {
 protected:
  PlanningProblem problem_ = test::post_problem();
  PlanRequest request_;
  Observer observer_;
};

TEST_F(Smoothing, ShortensWithoutLeavingWhatIsFree) {
  PlanningContext context(problem_, request_, {}, observer_);
  const Path path = wandering(context, problem_, 12);
  const Path smooth = smooth_by_roadmap(context, path);
  EXPECT_LT(path_length(problem_, smooth), 0.8 * path_length(problem_, path));
  EXPECT_LT(smooth.waypoints.size(), path.waypoints.size());
  EXPECT_EQ(smooth.waypoints.front(), problem_.start);
  EXPECT_EQ(smooth.waypoints.back(), problem_.goal);
  for (std::size_t i = 0; i + 1 < smooth.waypoints.size(); ++i) {
    EXPECT_TRUE(context.validator().edge_free(smooth.waypoints[i], smooth.waypoints[i + 1])) << i;
  }
}

// The length of the shortest way over all free edges between the path's nodes.
double shortest_way(PlanningContext& context, const Path& path) {
  const std::size_t count = path.waypoints.size();
  Eigen::MatrixXd lengths(count, count);
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = 0; b < count; ++b) {
      const Configuration& from = path.waypoints[std::min(a, b)];
      const Configuration& to = path.waypoints[std::max(a, b)];
      lengths(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) =
          context.validator().edge_free(from, to)
              ? normalised_distance(context.problem().model(), from, to)
              : std::numeric_limits<double>::infinity();
    }
  }
  for (Eigen::Index by = 0; by < lengths.rows(); ++by) {  // Floyd, Warshall
    for (Eigen::Index a = 0; a < lengths.rows(); ++a) {
      for (Eigen::Index b = 0; b < lengths.rows(); ++b) {
        lengths(a, b) = std::min(lengths(a, b), lengths(a, by) + lengths(by, b));
      }
    }
  }
  return lengths(0, lengths.cols() - 1);
}

// Thin posts wherever the arm gets: paths among them lead about.
PlanningProblem among_posts() {
  geometric::Scene scene = test::scene_of(test::planar_hand_arm());
  int count = 0;
  for (const double radius : {0.4, 0.55, 0.7}) {
    for (const double angle : {-0.8, 0.0, 0.8, 1.6}) {
      test::add_object(scene, "post " + std::to_string(++count), geometric::Cylinder{0.01, 0.3},
                       {radius * std::cos(angle), radius * std::sin(angle), 0.0});
    }
  }
  return test::planar_problem(std::move(scene), planar_configuration(-0.4, 0.0),
                              planar_configuration(0.4, 0.0));
}

TEST_F(Smoothing, GoesBackAlongThePathWhereThatIsShorterAsPrinted) {
  const PlanningProblem problem = among_posts();
  PlanningContext context(problem, request_, {}, observer_);
  int shorter = 0;
  for (std::uint64_t seed = 31; seed <= 36; ++seed) {
    const Path path = walk(context, problem, 20, 0.25, seed);
    const Path forwards = smooth_by_roadmap(context, path);
    const Path both_ways = smooth_by_roadmap(context, path, SmoothingEdges::kBothWays);
    const double length = path_length(problem, both_ways);
    EXPECT_NEAR(length, shortest_way(context, path), 1e-12) << seed;
    shorter += length < path_length(problem, forwards) - 1e-9 ? 1 : 0;
    for (std::size_t i = 0; i + 1 < both_ways.waypoints.size(); ++i) {
      EXPECT_TRUE(context.validator().edge_free(both_ways.waypoints[i], both_ways.waypoints[i + 1]))
          << i;
    }
  }
  EXPECT_EQ(shorter, 1) << "the walk of seed 35";
}

TEST_F(Smoothing, KeepsAStraightLine) {
  const PlanningProblem problem = test::open_problem();
  PlanningContext context(problem, request_, {}, observer_);
  const Path straight{{problem.start, problem.goal}};
  EXPECT_EQ(smooth_by_roadmap(context, straight).waypoints, straight.waypoints);
  const Path with_middle{{problem.start, 0.5 * (problem.start + problem.goal), problem.goal}};
  EXPECT_NEAR(path_length(problem, smooth_by_roadmap(context, with_middle)),
              path_length(problem, straight), 1e-12);
}

TEST_F(Smoothing, KeepsAPathWhenStoppedAtOnce) {
  PlanningContext free(problem_, request_, {}, observer_);
  const Path path = wandering(free, problem_, 6);
  std::stop_source stop;
  stop.request_stop();
  PlanningContext stopped(problem_, request_, stop.get_token(), observer_);
  const Path smooth = smooth_by_roadmap(stopped, path);
  EXPECT_EQ(smooth.waypoints.front(), problem_.start);
  EXPECT_EQ(smooth.waypoints.back(), problem_.goal);
  for (std::size_t i = 0; i + 1 < smooth.waypoints.size(); ++i) {
    EXPECT_TRUE(free.validator().edge_free(smooth.waypoints[i], smooth.waypoints[i + 1])) << i;
  }
}

}  // namespace
}  // namespace handway::planning
