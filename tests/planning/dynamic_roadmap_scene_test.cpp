/// A dynamic roadmap on a scene that ships.
#include "handway/geometric/collision/continuous/continuous_collision_checker.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/replanning/dynamic_roadmap.h"
#include "handway_test/known_problems.h"
#include "handway_test/roadmap_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace handway::planning {
namespace {

TEST(DynamicRoadmapOfCanOnTable, FollowsTheCanWithFewerChecksThanPlanningAnew) {
  const std::vector<test::KnownProblem> all = test::known_problems();
  const auto found = std::ranges::find(all, "can_on_table", &test::KnownProblem::name);
  ASSERT_NE(found, all.end());
  const SceneState loaded = test::load(*found);
  DynamicRoadmap roadmap(make_problem(loaded.scene, loaded.basis));
  ASSERT_TRUE(roadmap.plan({}).solved());
  geometric::Pose X_WCan = geometric::find_object(*loaded.scene, "can")->X_PO;
  X_WCan.translation().x() -= 0.01;
  test::move_object(roadmap, "can", X_WCan);
  const PlanResult result = roadmap.plan({});
  ASSERT_TRUE(result.solved()) << result.reason;
  const PlanningProblem& problem = roadmap.problem();
  const PlanResult anew = PlannerRegistry().create("auto")->plan(problem, {});
  ASSERT_TRUE(anew.solved());
  EXPECT_LT(result.statistics.checks(), anew.statistics.checks());
  const std::unique_ptr<geometric::CollisionChecker> checker = problem.checker->clone();
  geometric::ContinuousCollisionChecker edges(*checker, problem.motion, 4e-5);
  for (std::size_t i = 0; i + 1 < result.path.waypoints.size(); ++i) {
    EXPECT_TRUE(edges.check(result.path.waypoints[i], result.path.waypoints[i + 1]).free) << i;
  }
}

}  // namespace
}  // namespace handway::planning
