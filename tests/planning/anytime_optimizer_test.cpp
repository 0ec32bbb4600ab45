/// Optimising paths along any route, for as long as there is time.
#include "handway/planning/paths/anytime_optimizer.h"

#include "handway/planning/paths/path_check.h"
#include "handway/planning/planners/planner.h"
#include "handway_test/planar_problems.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

namespace handway::planning {
namespace {

constexpr double kDenseResolution = 1e-3;  // m
const ObjectiveWeights kShortest{};

auto rounds_up_to(std::uint64_t checks) {
  return [checks](std::uint64_t done) { return done < checks; };
}

class Anytime : public testing::Test {
 protected:
  /// A path of `planner`, which nobody has shortened.
  Path found(const PlanningProblem& problem, std::uint64_t seed = 1) {
    const auto planner = PlannerRegistry().create("rrt-connect");
    planner->set_parameter("smoothing_checks", "0");
    return planner->plan(problem, {.seed = seed}).path;
  }
  PlanningProblem problem_ = test::post_problem();
  PlanRequest request_;
  Observer observer_;
};

TEST_F(Anytime, IsNeverBelowTheLeastCostAndNeverAboveTheLocalOptimum) {
  const Path path = found(problem_);
  ASSERT_FALSE(path.empty());
  for (const ObjectiveWeights& weights : {kShortest, ObjectiveWeights{.human_likeness = 10.0},
                                          ObjectiveWeights{.length = 0.01, .duration = 1.0}}) {
    PlanningContext alone(problem_, request_, {}, observer_);
    PathOptimizer local(alone, weights, path, 3, PathOptimizer::kThorough);
    local.advance_in_rounds(rounds_up_to(1'000'000));
    PlanningContext context(problem_, request_, {}, observer_);
    AnytimeOptimizer optimizer(context, weights, path, 3);
    optimizer.advance_in_rounds(rounds_up_to(100'000));
    EXPECT_LE(optimizer.cost(), local.cost());
    EXPECT_GE(optimizer.cost(), optimizer.least_cost());
    EXPECT_NEAR(optimizer.cost(), Objective(problem_, weights).cost(optimizer.path()), 1e-9);
    const PathCheckResult check = check_path(problem_, optimizer.path(), kDenseResolution);
    EXPECT_TRUE(check.valid()) << (check.faults.empty() ? "" : check.faults.front());
  }
}

/// The arm has to fold to pass a wall; its elbow is already bent to one side.
PlanningProblem wall_problem() {
  geometric::Scene scene = test::scene_of(test::planar_hand_arm());
  test::add_object(scene, "wall", geometric::Box{{0.4, 0.01, 0.3}}, Eigen::Vector3d(0.7, 0.0, 0.0));
  return test::planar_problem(std::move(scene), test::planar_configuration(-1.0, 1.0),
                              test::planar_configuration(1.0, 1.0));
}

TEST_F(Anytime, FindsAnotherRouteThanThatOfTheGivenPath) {
  const PlanningProblem wall = wall_problem();
  Path folded;  // to the other side
  folded.waypoints = {wall.start,
                      test::planar_configuration(-1.8, 1.0),
                      test::planar_configuration(-1.8, -2.2),
                      test::planar_configuration(1.8, -2.2),
                      test::planar_configuration(1.8, 1.0),
                      wall.goal};
  ASSERT_TRUE(check_path(wall, folded, kDenseResolution).valid());
  PlanningContext alone(wall, request_, {}, observer_);
  PathOptimizer local(alone, kShortest, folded, 3, PathOptimizer::kThorough);
  local.advance_in_rounds(rounds_up_to(1'000'000));
  PlanningContext context(wall, request_, {}, observer_);
  AnytimeOptimizer optimizer(context, kShortest, folded, 3);
  optimizer.advance_in_rounds(rounds_up_to(100'000));
  EXPECT_LT(optimizer.cost(), 0.8 * local.cost());
  EXPECT_TRUE(check_path(wall, optimizer.path(), kDenseResolution).valid());
}

TEST_F(Anytime, GoesOnLaterAsIfItHadNotPaused) {
  const Path path = found(problem_);
  PlanningContext context(problem_, request_, {}, observer_);
  AnytimeOptimizer at_once(context, kShortest, path, 3);
  EXPECT_EQ(at_once.advance_in_rounds(rounds_up_to(40'000)), 40'000U);
  PlanningContext other(problem_, request_, {}, observer_);
  AnytimeOptimizer with_pause(other, kShortest, path, 3);
  with_pause.advance_in_rounds(rounds_up_to(25'000));
  with_pause.advance_in_rounds(rounds_up_to(15'000));
  EXPECT_EQ(with_pause.path().waypoints, at_once.path().waypoints);
}

TEST_F(Anytime, ConvergesAtOnceWhereTheStraightMotionIsFree) {
  const PlanningProblem open = test::open_problem();
  PlanningContext context(open, request_, {}, observer_);
  AnytimeOptimizer optimizer(context, kShortest, {{open.start, open.goal}}, 1);
  EXPECT_TRUE(optimizer.converged());
  EXPECT_NEAR(optimizer.cost(), optimizer.least_cost(), 1e-12);
}

TEST_F(Anytime, ConvergesAfterItsPatience) {
  PlanningContext context(problem_, request_, {}, observer_);
  AnytimeOptimizer optimizer(context, kShortest, found(problem_), 3);
  optimizer.set_patience(20'000);
  EXPECT_LT(optimizer.advance_in_rounds(rounds_up_to(10'000'000)), 1'000'000U);
  EXPECT_TRUE(optimizer.converged());
}

TEST_F(Anytime, IsWhatPlannersDoWithTheirOptimisationChecks) {
  const auto planner = PlannerRegistry().create("auto");
  planner->set_parameter("objective", "shortest");
  const PlanResult plain = planner->plan(problem_, {});
  EXPECT_FALSE(plain.cost);
  planner->set_parameter("optimize_checks", "20000");
  const PlanResult optimized = planner->plan(problem_, {});
  ASSERT_TRUE(optimized.cost);
  EXPECT_NEAR(optimized.cost->cost, Objective(problem_, kShortest).cost(optimized.path), 1e-9);
  EXPECT_LE(optimized.cost->cost, Objective(problem_, kShortest).cost(plain.path));
  EXPECT_GT(optimized.cost->gap(), 0.0);
  EXPECT_LT(optimized.cost->gap(), 1.0);
}

}  // namespace
}  // namespace handway::planning
