#include "handway/planning/queries/nearest_free.h"

#include "handway_test/planar_problems.h"

#include <gtest/gtest.h>

#include <limits>

namespace handway::planning {
namespace {

using geometric::degrees;
using geometric::radians;
using test::planar_configuration;

bool is_free(const PlanningProblem& problem, const Configuration& q) {
  const auto checker = problem.checker->clone();
  return !checker->first_collision(q);
}

/// The stretched arm with a wall across the hand's way; its face is at `y` m.
PlanningProblem hand_at_wall(double y) {
  geometric::Scene scene = test::scene_of(test::planar_hand_arm());
  test::add_object(scene, "wall", geometric::Box{{0.4, 0.1, 0.3}},
                   Eigen::Vector3d(0.7, y + 0.05, 0.0));
  return test::planar_problem(std::move(scene), planar_configuration(-0.6, 0.0),
                              planar_configuration(0.0, 0.0));
}

TEST(NearestFree, LeavesAFreeConfigurationAlone) {
  const PlanningProblem problem = test::open_problem();
  const NearestFree found = find_nearest_free(problem, problem.goal);
  ASSERT_TRUE(found.q);
  EXPECT_EQ(*found.q, problem.goal);
  EXPECT_EQ(found.distance, 0.0);
  EXPECT_EQ(found.checks, 1);
}

TEST(NearestFree, BacksOutOfAWallByLittle) {
  // At 12 mm from the arm's axis the wall is some way into the hand.
  const PlanningProblem problem = hand_at_wall(0.012);
  ASSERT_FALSE(is_free(problem, problem.goal));
  const NearestFree found = find_nearest_free(problem, problem.goal);
  ASSERT_TRUE(found.q);
  EXPECT_TRUE(is_free(problem, *found.q));
  EXPECT_GT(found.distance, 0.0);
  // Turning the shoulder alone gets there, at this angle; together the joints need less.
  double alone = 0.0;
  while (!is_free(problem, planar_configuration(-alone, 0.0))) {
    alone += radians(0.05);
  }
  EXPECT_LT(degrees(found.distance), degrees(alone) + 0.1);
  EXPECT_EQ(found.distance, (*found.q - problem.goal).norm());
}

TEST(NearestFree, KeepsTheClearanceThatIsAskedFor) {
  const PlanningProblem problem = hand_at_wall(0.012);
  NearestFreeOptions options;
  options.clearance = 0.004;
  const NearestFree found = find_nearest_free(problem, problem.goal, options);
  ASSERT_TRUE(found.q);
  const auto checker = problem.checker->clone();
  EXPECT_GE(geometric::find_clearance(*checker, *found.q).distance, 0.004);
  EXPECT_GT(found.distance, find_nearest_free(problem, problem.goal).distance);
}

TEST(NearestFree, BringsAConfigurationWithinItsLimits) {
  const PlanningProblem problem = test::open_problem();
  Configuration q = problem.goal;
  q[0] = problem.model().upper()[0] + 0.1;
  const NearestFree found = find_nearest_free(problem, q);
  ASSERT_TRUE(found.q);
  EXPECT_NEAR(found.distance, 0.1, 1e-9);
  EXPECT_TRUE(((*found.q).array() <= problem.model().upper().array()).all());
}

TEST(NearestFree, GivesTheSameForTheSameSeed) {
  const PlanningProblem problem = hand_at_wall(0.0);
  const NearestFree one = find_nearest_free(problem, problem.goal);
  const NearestFree other = find_nearest_free(problem, problem.goal);
  ASSERT_TRUE(one.q);
  EXPECT_EQ(*one.q, *other.q);
  EXPECT_EQ(one.checks, other.checks);
}

TEST(NearestFree, GivesUpWhereThereIsNone) {
  geometric::Scene scene = test::scene_of(test::planar_hand_arm());
  // The post goes through both links, wherever the shoulder turns.
  test::add_object(scene, "post", geometric::Cylinder{0.06, 0.3}, Eigen::Vector3d(0.1, 0.0, 0.0));
  const PlanningProblem problem = test::planar_problem(
      std::move(scene), planar_configuration(2.0, 0.0), planar_configuration(0.0, 0.0));
  NearestFreeOptions options;
  options.most_distance = radians(3.0);
  const NearestFree found = find_nearest_free(problem, problem.goal, options);
  EXPECT_FALSE(found.q);
  EXPECT_LE(found.checks, options.most_checks);
}

TEST(NearestFree, EndsWhenItIsTold) {
  const PlanningProblem problem = hand_at_wall(0.0);
  std::stop_source stop;
  stop.request_stop();
  const NearestFree found = find_nearest_free(problem, problem.goal, {}, stop.get_token());
  EXPECT_FALSE(found.q);
  EXPECT_EQ(found.checks, 0);
}

TEST(NearestFree, TellsWhatChanged) {
  const PlanningProblem problem = test::open_problem();
  const Configuration from = planar_configuration(0.0, 0.0);
  const Configuration to = planar_configuration(radians(1.0), radians(-2.0), radians(0.1));
  EXPECT_EQ(describe_change(problem.model(), from, to),
            "elbow -2.0°, shoulder +1.0°, 1 more joint");
  EXPECT_EQ(describe_change(problem.model(), from, from), "nothing");
}

}  // namespace
}  // namespace handway::planning
