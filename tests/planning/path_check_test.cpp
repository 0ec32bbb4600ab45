#include "handway/planning/paths/path_check.h"

#include "handway/geometric/robot/robot_state.h"
#include "handway_test/planar_problems.h"
#include "handway_test/solid_robots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <utility>

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
  EXPECT_GT(result.min_clearance, 0.0);
  EXPECT_FALSE(result.closest_pair.empty());
  // 1.1 rad at more than 0.6 m are at least 660 mm.
  EXPECT_GT(result.configurations, 660U);
}

TEST(PathCheck, FindsACollisionInTheMiddle) {
  const PlanningProblem problem = test::post_problem();
  const PathCheckResult result = check_path(problem, straight(problem), kMillimetre);
  EXPECT_FALSE(result.valid());
  EXPECT_GT(result.collisions, 10U);
  EXPECT_EQ(result.min_clearance, 0.0);
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
  EXPECT_LE(fine.min_clearance, coarse.min_clearance + 1e-12);
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

// A post of 0.2 mm that the finger passes between two samples of 50 mm.
TEST(PathCheck, CertifiesWhatSamplesMiss) {
  const PlanningProblem open = test::open_problem();
  geometric::Scene scene = *open.scene;
  const Configuration middle = 0.5 * (open.start + open.goal);
  geometric::RobotState state(scene.robots.front().model);
  state.set_configuration(middle);
  const geometric::Pose X_WL = state.link_pose("upper");
  test::add_object(scene, "needle", geometric::Cylinder{1e-4, 1.0},
                   Eigen::Vector3d(X_WL * Eigen::Vector3d(0.29, 0.0, 0.0)));
  const PlanningProblem problem =
      make_problem(std::make_shared<const geometric::Scene>(std::move(scene)), nullptr);
  const Path path = straight(problem);
  const PathCheckResult result = check_path(problem, path, 0.5);
  EXPECT_FALSE(result.valid());
}

TEST(PathCheck, NamesATurnThatIsLongerThanHalfOne) {
  geometric::RobotDescription robot = test::planar_hand_arm();
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  robot.joints.front().limits.lower = -kEndless;
  robot.joints.front().limits.upper = kEndless;
  geometric::Scene scene = test::scene_of(std::move(robot));
  scene.start = planar_configuration(3.05, 0.3);
  scene.goal = planar_configuration(-3.02, 0.3);
  const PlanningProblem problem =
      make_problem(std::make_shared<const geometric::Scene>(std::move(scene)), nullptr);
  const Path jumping{{*problem.scene->start, *problem.scene->goal}};
  EXPECT_THAT(check_path(problem, jumping, 0.01).faults,
              testing::Contains(HasSubstr("joint shoulder turns by -348° at once")));
  const Path unwrapped{{problem.start, problem.goal}};
  EXPECT_THAT(check_path(problem, unwrapped, 0.01).faults, IsEmpty());
}

TEST(PathCheck, NeedsNoGoal) {
  const PlanningProblem open = test::open_problem();
  geometric::Scene scene = *open.scene;
  scene.start = open.start;
  scene.goal.reset();
  const PlanningProblem problem = make_problem(
      std::make_shared<const geometric::Scene>(std::move(scene)), nullptr, {}, GoalNeed::kOptional);
  EXPECT_FALSE(problem.has_goal);
  EXPECT_TRUE(check_path(problem, straight(open), kMillimetre).valid());
}

}  // namespace
}  // namespace handway::planning
