#include "handway/planning/replanning/dynamic_roadmap.h"

#include "handway/geometric/collision/continuous/continuous_collision_checker.h"
#include "handway/planning/planners/planner.h"
#include "handway_test/planar_problems.h"
#include "handway_test/roadmap_scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::planning {
namespace {

using geometric::Pose;
using test::planar_configuration;
using testing::HasSubstr;

Pose at(double x, double y) { return Pose(Eigen::Translation3d(x, y, 0.0)); }

// Checks the result with a checker made for the present scene, on all pairs.
void expect_valid(DynamicRoadmap& roadmap, const PlanResult& result) {
  ASSERT_TRUE(result.solved()) << result.reason;
  const PlanningProblem problem = [&] {
    PlanningProblem anew = roadmap.problem();
    auto scene = std::make_shared<geometric::Scene>(*anew.scene);
    scene->start = anew.start;
    scene->goal = anew.goal;
    return make_problem(scene, anew.basis);
  }();
  const std::unique_ptr<geometric::CollisionChecker> checker = problem.checker->clone();
  geometric::ContinuousCollisionChecker edges(*checker, problem.motion, 4e-5);
  EXPECT_EQ(result.path.waypoints.front(), problem.start);
  const Configuration& end = result.path.waypoints.back();
  EXPECT_TRUE(problem.model().nearest_equivalent(end, problem.goal).isApprox(end, 1e-12));
  for (std::size_t i = 0; i < result.path.waypoints.size(); ++i) {
    EXPECT_FALSE(checker->first_collision(result.path.waypoints[i])) << "waypoint " << i;
    if (i > 0) {
      EXPECT_TRUE(edges.check(result.path.waypoints[i - 1], result.path.waypoints[i]).free)
          << "edge " << i;
    }
  }
  EXPECT_GT(result.certificate.min_clearance, 0.0);
}

std::uint64_t checks_anew(DynamicRoadmap& roadmap) {
  const PlanResult result = PlannerRegistry().create("auto")->plan(roadmap.problem(), {});
  EXPECT_TRUE(result.solved());
  return result.statistics.checks();
}

/// The hand sweeps across a post, which moves.
class MovingPost : public testing::Test {
 protected:
  static constexpr double kPostX = 0.755;

  PlanResult plan() { return roadmap_.plan(request_); }
  ReplanSource source() { return roadmap_.source(); }

  PlanRequest request_{.time_limit_s = 60.0};
  DynamicRoadmap roadmap_{test::post_problem()};
};

// The shoulder turns on without end: after each path it starts where the last one ended.
TEST(AContinuousJoint, IsReplannedFromWhicheverTurnItIsAt) {
  DynamicRoadmap roadmap(test::endless_problem(2.7, -2.7));
  Configuration here = test::planar_configuration(2.7, 0.0);
  const Configuration there = test::planar_configuration(-2.7, 0.0);
  const geometric::SceneObject wall = test::endless_problem_with_wall().scene->objects.back();
  for (int round = 0; round < 6; ++round) {
    if (round == 2) {
      test::add_object(roadmap, wall);
    } else if (round == 4) {
      test::remove_object(roadmap, wall.name);
    }
    test::set_start(roadmap, here);
    test::set_goal(roadmap, round % 2 == 0 ? there : test::planar_configuration(2.7, 0.0));
    const PlanResult result = roadmap.plan({.time_limit_s = 60.0});
    expect_valid(roadmap, result);
    EXPECT_EQ(result.path.waypoints.front(), here) << round;
    here = result.path.waypoints.back();
  }
}

TEST_F(MovingPost, KeepsAPathThatStaysFree) {
  const PlanResult first = plan();
  expect_valid(roadmap_, first);
  EXPECT_EQ(source(), ReplanSource::kPlanner);
  test::move_object(roadmap_, "post", at(-0.5, 0.0));
  const PlanResult second = plan();
  expect_valid(roadmap_, second);
  EXPECT_EQ(source(), ReplanSource::kLastPath);
  EXPECT_EQ(second.path.waypoints, first.path.waypoints);
  EXPECT_GT(second.statistics.checks(), 2U) << "the post is asked about again";
}

TEST_F(MovingPost, KeepsAPathThatWasPlannedElsewhere) {
  const PlanResult planned = PlannerRegistry().create("rrt-connect")->plan(roadmap_.problem(), {});
  ASSERT_TRUE(planned.solved());
  roadmap_.adopt(planned.path);
  const PlanResult kept = plan();
  expect_valid(roadmap_, kept);
  EXPECT_EQ(roadmap_.source(), ReplanSource::kLastPath);
  EXPECT_EQ(kept.path.waypoints, planned.path.waypoints);
}

TEST_F(MovingPost, TakesOverAProblemThatWasMadeElsewhere) {
  (void)plan();
  const PlanningProblem before = roadmap_.problem();
  auto scene = std::make_shared<geometric::Scene>(*before.scene);
  scene->start = before.start;
  scene->goal = before.goal;
  scene->objects.front().X_PO = at(kPostX + 0.003, 0.004);
  const PlanningProblem next = updated_problem(before, scene, before.basis);
  ASSERT_TRUE(roadmap_.follow(next));
  EXPECT_EQ(roadmap_.problem().checker, next.checker) << "no other one is made";
  expect_valid(roadmap_, plan());
  EXPECT_NE(source(), ReplanSource::kPlanner);
}

TEST_F(MovingPost, AsksNothingTwiceWhenNothingChanged) {
  const PlanResult first = plan();
  const PlanResult second = plan();
  EXPECT_EQ(second.path.waypoints, first.path.waypoints);
  EXPECT_EQ(second.statistics.checks(), 2U) << "start and goal";
}

TEST_F(MovingPost, FollowsSmallMovesWithFewerChecksThanPlanningAnew) {
  (void)plan();
  std::uint64_t checks = 0;
  std::uint64_t anew = 0;
  for (int step = 1; step <= 6; ++step) {
    test::move_object(roadmap_, "post", at(kPostX + 0.003 * step, 0.004 * step));
    const PlanResult result = plan();
    expect_valid(roadmap_, result);
    checks += result.statistics.checks();
    anew += checks_anew(roadmap_);
  }
  EXPECT_LT(checks, anew / 2);
}

TEST_F(MovingPost, LeadsThePathAroundWhatIsPutIntoIt) {
  test::move_object(roadmap_, "post", at(-0.5, 0.0));
  const PlanResult straight = plan();
  expect_valid(roadmap_, straight);
  EXPECT_EQ(straight.path.waypoints.size(), 2U);
  test::move_object(roadmap_, "post", at(kPostX, 0.0));
  const PlanResult around = plan();
  expect_valid(roadmap_, around);
  EXPECT_NE(around.path.waypoints, straight.path.waypoints);
}

TEST_F(MovingPost, RevivesWhatWasRefusedBecauseOfAnObjectThatLeft) {
  test::move_object(roadmap_, "post", at(-0.5, 0.0));
  const PlanResult straight = plan();
  test::move_object(roadmap_, "post", at(kPostX, 0.0));
  (void)plan();
  test::move_object(roadmap_, "post", at(-0.5, 0.0));
  const PlanResult back = plan();
  EXPECT_EQ(back.path.waypoints, straight.path.waypoints) << "the shorter way is free again";
  EXPECT_EQ(source(), ReplanSource::kRoadmap);
}

TEST_F(MovingPost, PlansWithoutAnObjectThatIsTakenAwayAndWithOneThatComes) {
  const geometric::SceneObject post = roadmap_.problem().scene->objects.front();
  (void)plan();
  test::remove_object(roadmap_, "post");
  EXPECT_TRUE(roadmap_.problem().scene->objects.empty());
  expect_valid(roadmap_, plan());
  EXPECT_NE(source(), ReplanSource::kPlanner);
  test::add_object(roadmap_, post);
  expect_valid(roadmap_, plan());
  geometric::SceneObject far = post;
  far.name = "another post";
  far.X_PO = at(-0.6, 0.0);
  test::add_object(roadmap_, far);
  expect_valid(roadmap_, plan());
  EXPECT_EQ(source(), ReplanSource::kLastPath);
}

TEST_F(MovingPost, FollowsItsEnds) {
  (void)plan();
  test::set_goal(roadmap_, planar_configuration(0.45, 0.05, 0.1));
  const PlanResult other_goal = plan();
  expect_valid(roadmap_, other_goal);
  EXPECT_NE(source(), ReplanSource::kPlanner);
  EXPECT_LT(other_goal.statistics.checks(), checks_anew(roadmap_));
  test::set_start(roadmap_, planar_configuration(-0.45, 0.05));
  expect_valid(roadmap_, plan());
  EXPECT_NE(source(), ReplanSource::kPlanner);
}

TEST_F(MovingPost, SaysWhenAnEndIsInCollisionAndGoesOnAfterwards) {
  const PlanResult first = plan();
  test::move_object(roadmap_, "post",
                    at(0.4 * std::cos(0.4), 0.4 * std::sin(0.4)));  // in the goal's lower arm
  const PlanResult blocked = plan();
  EXPECT_EQ(blocked.status, PlanStatus::kGoalInvalid);
  EXPECT_THAT(blocked.reason, HasSubstr("post"));
  EXPECT_TRUE(blocked.path.waypoints.empty());
  EXPECT_EQ(source(), ReplanSource::kNone);
  test::move_object(roadmap_, "post", at(0.4 * std::cos(0.4), -0.4 * std::sin(0.4)));
  EXPECT_EQ(plan().status, PlanStatus::kStartInvalid);
  test::move_object(roadmap_, "post", at(kPostX, 0.0));
  const PlanResult again = plan();
  EXPECT_EQ(again.path.waypoints, first.path.waypoints);
  EXPECT_EQ(source(), ReplanSource::kLastPath);
}

TEST_F(MovingPost, StopsWhenAskedTo) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(roadmap_.plan(request_, stop.get_token()).status, PlanStatus::kCancelled);
  expect_valid(roadmap_, plan());
}

TEST_F(MovingPost, ForgetsWhatIsTooMuch) {
  DynamicRoadmap small(test::post_problem(), nullptr, 12);
  for (int step = 0; step <= 8; ++step) {
    test::move_object(small, "post", at(kPostX + 0.004 * step, 0.01 * (step % 3)));
    const PlanResult result = small.plan(request_);
    expect_valid(small, result);
    EXPECT_LE(result.statistics.nodes, 12 + 2 * result.path.waypoints.size());
  }
}

TEST_F(MovingPost, PlansOverAllJointsWithoutABasis) {
  PlanningProblem problem = test::post_problem();
  problem.basis = nullptr;
  DynamicRoadmap roadmap(problem);
  expect_valid(roadmap, roadmap.plan(request_));
  test::move_object(roadmap, "post", at(kPostX - 0.01, 0.01));
  expect_valid(roadmap, roadmap.plan(request_));
}

/// Records its notifications.
class Recorder : public Observer {
 public:
  void on_node(const NodeEvent& node) override { EXPECT_TRUE(nodes.insert(node.id).second); }
  void on_edge(int from, int to) override {
    EXPECT_TRUE(nodes.contains(from) && nodes.contains(to));
  }

  std::set<int> nodes;
};

TEST_F(MovingPost, TellsAnObserverOfItsNodes) {
  Recorder first;
  (void)roadmap_.plan(request_, {}, &first);
  EXPECT_FALSE(first.nodes.empty());
  test::move_object(roadmap_, "post", at(kPostX - 0.02, 0.02));
  Recorder second;
  (void)roadmap_.plan(request_, {}, &second);
}

TEST_F(MovingPost, ShowsAnObserverThePathThatIsOptimised) {
  struct Watcher final : Observer {
    void on_path(const Path& path) override { waypoints = path.waypoints.size(); }
    std::size_t waypoints = 0;
  } watcher;
  request_.optimize_s = 0.01;
  ASSERT_TRUE(roadmap_.plan(request_, {}, &watcher).solved());
  EXPECT_GE(watcher.waypoints, 2U);
}

TEST(DynamicRoadmap, GivesTheSamePathsForAnyNumberOfThreads) {
  const auto paths = [](int threads) {
    DynamicRoadmap roadmap(test::post_problem());
    std::vector<std::vector<Configuration>> found;
    for (int step = 0; step < 8; ++step) {
      test::move_object(roadmap, "post", at(0.74 + 0.005 * step, 0.02 * (step % 3)));
      found.push_back(roadmap.plan({.threads = threads}).path.waypoints);
    }
    return found;
  };
  const auto expected = paths(1);
  EXPECT_EQ(paths(1), expected);
  EXPECT_EQ(paths(2), expected);
}

TEST(DynamicRoadmap, TakesAWayThatOpens) {
  DynamicRoadmap roadmap(test::walled_in_problem());
  EXPECT_EQ(roadmap.plan({.time_limit_s = 0.2}).status, PlanStatus::kTimeLimit);
  test::remove_object(roadmap, "right wall");
  expect_valid(roadmap, roadmap.plan({.time_limit_s = 60.0}));
}

}  // namespace
}  // namespace handway::planning
