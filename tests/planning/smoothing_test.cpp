#include "handway/planning/paths/roadmap_smoothing.h"
#include "handway_test/planar_problems.h"

#include <gtest/gtest.h>

#include <random>
#include <stop_token>

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

/// A free random walk from the start with `steps` stretches, then back and on to the goal.
Path wandering(PlanningContext& context, const PlanningProblem& problem, int steps) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> share(-0.1, 0.1);
  Path path{{problem.start}};
  while (static_cast<int>(path.waypoints.size()) <= steps) {
    Configuration next = path.waypoints.back();
    for (int v = 0; v < next.size(); ++v) {
      const double range = problem.model().upper()[v] - problem.model().lower()[v];
      next[v] = std::clamp(next[v] + share(random) * range, problem.model().lower()[v],
                           problem.model().upper()[v]);
    }
    if (!context.collision(next) && context.edge_free(path.waypoints.back(), next)) {
      path.waypoints.push_back(next);
    }
  }
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
    EXPECT_TRUE(context.edge_free(smooth.waypoints[i], smooth.waypoints[i + 1])) << i;
  }
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
    EXPECT_TRUE(free.edge_free(smooth.waypoints[i], smooth.waypoints[i + 1])) << i;
  }
}

}  // namespace
}  // namespace handway::planning
