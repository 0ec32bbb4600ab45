#include "handway/planning/paths/path_check.h"

#include "handway_test/planar_problems.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace handway::planning {
namespace {

using test::planar_configuration;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kMillimetre = 0.001;

Path straight(const PlanningProblem& problem) { return {{problem.start, problem.goal}}; }

TEST(PathCheck, PassesAFreePath) {
  const PlanningProblem problem = test::open_problem();
  const PathCheckResult result = check_path(problem, straight(problem), kMillimetre);
  EXPECT_TRUE(result.valid());
  EXPECT_THAT(result.faults, IsEmpty());
  EXPECT_EQ(result.collisions, 0U);
  EXPECT_GT(result.min_clearance_mm, 0.0);
  EXPECT_FALSE(result.closest_pair.empty());
  // 1.1 rad at more than 0.6 m are at least 660 mm.
  EXPECT_GT(result.configurations, 660U);
}

TEST(PathCheck, FindsACollisionInTheMiddle) {
  const PlanningProblem problem = test::post_problem();
  const PathCheckResult result = check_path(problem, straight(problem), kMillimetre);
  EXPECT_FALSE(result.valid());
  EXPECT_GT(result.collisions, 10U);
  EXPECT_EQ(result.min_clearance_mm, 0.0);
  EXPECT_THAT(result.faults,
              ElementsAre(AllOf(HasSubstr("with post"), HasSubstr("after waypoint 1"))));
}

TEST(PathCheck, SaysOnWhichStretch) {
  const PlanningProblem problem = test::post_problem();
  const Path path{{problem.start, planar_configuration(-0.38, 0), planar_configuration(-0.36, 0),
                   planar_configuration(0.38, 0), problem.goal}};
  EXPECT_THAT(check_path(problem, path, kMillimetre).faults,
              ElementsAre(HasSubstr("after waypoint 3")));
}

TEST(PathCheck, FindsACollisionAroundAWaypoint) {
  const PlanningProblem problem = test::post_problem();
  Path path{{problem.start, planar_configuration(-0.4, 0, 0, 1.5, 1.5),
             planar_configuration(0.4, 0, 0, 1.5, 1.5), problem.goal}};
  ASSERT_TRUE(check_path(problem, path, kMillimetre).valid()) << "spread fingers pass the post";
  // Here the left finger is stretched through it.
  path.waypoints.insert(path.waypoints.begin() + 2, planar_configuration(-0.066, 0, 0, 0.0, 1.5));
  EXPECT_THAT(check_path(problem, path, kMillimetre).faults,
              ElementsAre(AllOf(HasSubstr("left_tip with post"), HasSubstr("after waypoint 2"))));
}

TEST(PathCheck, ComparesTheEnds) {
  const PlanningProblem problem = test::open_problem();
  Path path = straight(problem);
  path.waypoints.front()[0] += 0.002;
  path.waypoints.back()[0] -= 0.002;
  EXPECT_THAT(check_path(problem, path, kMillimetre).faults,
              ElementsAre(HasSubstr("start"), HasSubstr("end")));
  path = straight(problem);
  path.waypoints.front()[0] += 1e-5;
  EXPECT_TRUE(check_path(problem, path, kMillimetre).valid());
}

TEST(PathCheck, ComparesTheLimits) {
  const PlanningProblem problem = test::open_problem();
  Path path = straight(problem);
  path.waypoints.insert(path.waypoints.begin() + 1, planar_configuration(0.1, 0, 0, -0.1, 0));
  const PathCheckResult result = check_path(problem, path, kMillimetre);
  EXPECT_THAT(result.faults, ElementsAre(AllOf(HasSubstr("Waypoint 2"), HasSubstr("left"))));
}

TEST(PathCheck, LooksMoreCloselyWhenAsked) {
  const PlanningProblem problem = test::open_problem();
  const auto coarse = check_path(problem, straight(problem), 0.01);
  const auto fine = check_path(problem, straight(problem), 0.001);
  EXPECT_NEAR(static_cast<double>(fine.configurations) / static_cast<double>(coarse.configurations),
              10.0, 0.5);
  EXPECT_LE(fine.min_clearance_mm, coarse.min_clearance_mm + 1e-9);
}

TEST(PathCheck, RefusesAPathWithoutWaypoints) {
  const PathCheckResult result = check_path(test::open_problem(), Path{}, kMillimetre);
  EXPECT_FALSE(result.valid());
  EXPECT_THAT(result.faults, ElementsAre(HasSubstr("no waypoints")));
}

TEST(PathCheck, RefusesWaypointsOfAnotherRobot) {
  const PlanningProblem problem = test::open_problem();
  Path path = straight(problem);
  path.waypoints.insert(path.waypoints.begin() + 1, Eigen::Vector3d(0, 0, 0));
  EXPECT_THAT(check_path(problem, path, kMillimetre).faults,
              ElementsAre(AllOf(HasSubstr("Waypoint 2"), HasSubstr("3 values"))));
}

}  // namespace
}  // namespace handway::planning
