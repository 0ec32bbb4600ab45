/// Goals as poses of a link: what inverse kinematics finds, what is planned to, and what is said
/// where nothing will do.
#include "handway/planning/core/pose_goals.h"

#include "handway/geometric/robot/robot_state.h"
#include "handway/planning/paths/path_check.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/replanning/dynamic_roadmap.h"
#include "handway_test/robots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

namespace handway::planning {
namespace {

using geometric::Pose;
using geometric::PoseGoal;
using geometric::Scene;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

/// An arm with balls at its elbow and flange, and a box beside it.
class PoseGoals : public testing::Test {
 protected:
  PoseGoals() {
    geometric::RobotDescription robot = test::ur5e();
    const auto add_ball = [&](const char* link, double radius) {
      const auto found = std::ranges::find(robot.links, link, &geometric::Link::name);
      found->collision.push_back({geometric::Sphere{radius}, Pose::Identity(), {}});
    };
    add_ball("link_3", 0.04);  // the elbow
    add_ball("link_6", 0.04);
    scene_.robots.push_back({"arm",
                             {},
                             std::make_shared<const geometric::RobotModel>(robot),
                             Pose(Eigen::Translation3d(1.0, 0.0, 0.0)),
                             geometric::Configuration::Zero(6)});
    start_.resize(6);
    start_ << 0.0, -1.0, 1.2, -0.3, 1.5, 0.0;
    scene_.start = start_;
    add_box("aside", {1.0, -1.5, 0.3});
  }

  void add_box(const std::string& name, const Eigen::Vector3d& place) {
    scene_.objects.push_back({name,
                              geometric::Box{{0.2, 0.2, 0.2}},
                              Pose(Eigen::Translation3d(place)),
                              {},
                              std::nullopt});
  }

  /// Returns the pose of the flange in `q`, in the world.
  [[nodiscard]] Pose flange(const Configuration& q) const {
    geometric::RobotState state(scene_.robots.front().model, scene_.robots.front().X_WB);
    state.set_configuration(q);
    return state.link_pose(6);
  }
  void add_goal(const Configuration& q) {
    PoseGoal goal;
    goal.link = "link_6";
    goal.X_WG = flange(q);
    scene_.goal_poses.push_back(goal);
  }
  [[nodiscard]] Configuration away() const {
    Configuration q = start_;
    q[0] += 1.2;
    q[3] += 0.4;
    return q;
  }
  [[nodiscard]] PlanningProblem problem() const {
    return make_problem(std::make_shared<const Scene>(scene_), nullptr);
  }
  [[nodiscard]] static PlanResult planned(const PlanningProblem& problem,
                                          const char* planner = "auto") {
    return PlannerRegistry().create(planner)->plan(problem, {.time_limit_s = 60.0});
  }

  Scene scene_;
  Configuration start_;
};

TEST_F(PoseGoals, HaveSeveralConfigurationsTheNearestFirst) {
  add_goal(away());
  const PlanningProblem problem = this->problem();
  ASSERT_GE(problem.goals.size(), 2U);
  EXPECT_TRUE(problem.goal_fault.empty());
  EXPECT_EQ(problem.goal, problem.goals.front().q);
  EXPECT_TRUE(problem.goal.isApprox(away(), 1e-5));
  for (std::size_t i = 0; i < problem.goals.size(); ++i) {
    EXPECT_LT((flange(problem.goals[i].q).matrix() - flange(away()).matrix()).norm(), 1e-5);
    if (i > 0) {
      EXPECT_GE(normalised_distance(problem.model(), start_, problem.goals[i].q),
                normalised_distance(problem.model(), start_, problem.goals[i - 1].q));
    }
  }
}

TEST_F(PoseGoals, AreReachedByWhatMovesOrNotAtAll) {
  Configuration near = start_;
  near[0] += 0.5;
  add_goal(near);
  scene_.group = {"joint_1"};
  const PlanningProblem problem = this->problem();
  ASSERT_FALSE(problem.goals.empty()) << problem.goal_fault;
  EXPECT_NEAR(problem.goal[0], near[0], 1e-5);
  EXPECT_EQ(problem.goal.tail(5), start_.tail(5));
  EXPECT_TRUE(planned(problem).solved());
  scene_.group = {"joint_3"};
  EXPECT_THAT(this->problem().goal_fault, HasSubstr("out of reach"));
  scene_.goal_poses.front().link = "link_2";
  EXPECT_THAT(this->problem().goal_fault, HasSubstr("out of reach")) << "no joint moves it";
}

TEST_F(PoseGoals, BeyondAllNumbersAreOutOfReach) {
  PoseGoal goal;
  goal.link = "link_6";
  goal.X_WG.translation().x() = 1e300;
  scene_.goal_poses.push_back(goal);
  const PlanningProblem problem = this->problem();
  EXPECT_TRUE(problem.goal.allFinite());
  EXPECT_THAT(problem.goal_fault, HasSubstr("misses goal pose of link link_6"));
  EXPECT_THAT(pose_goal_miss(scene_, start_), HasSubstr("misses goal pose of link link_6"));
}

TEST_F(PoseGoals, ArePlannedToAndPassTheCheck) {
  add_goal(away());
  const PlanningProblem problem = this->problem();
  for (const char* planner : {"auto", "rrt-connect"}) {
    const PlanResult result = planned(problem, planner);
    ASSERT_TRUE(result.solved()) << result.reason;
    EXPECT_EQ(result.goal, 0U);
    EXPECT_THAT(result.reason, HasSubstr("goal pose of link link_6, in configuration 1 of "));
    EXPECT_THAT(check_path(problem, result.path, 0.001).faults, IsEmpty());
  }
}

TEST_F(PoseGoals, TakeAnotherConfigurationWhereTheNearestCannotBeComeTo) {
  add_goal(away());
  PlanningProblem problem = this->problem();
  const Configuration reachable = problem.goals.front().q;
  problem.goals.insert(problem.goals.begin(), problem.goals.front());
  problem.goals.front().q[2] = 4.0;  // beyond its limit
  problem.goal = problem.goals.front().q;
  const PlanResult result = planned(problem);
  ASSERT_TRUE(result.solved()) << result.reason;
  EXPECT_EQ(result.goal, 1U);
  EXPECT_TRUE(result.path.waypoints.back().isApprox(reachable, 1e-9));
}

TEST_F(PoseGoals, AreAnyOfSeveral) {
  PoseGoal far;
  far.link = "link_6";
  far.X_WG.translation().x() = 5.0;
  scene_.goal_poses.push_back(far);
  add_goal(away());
  const PlanResult result = planned(problem());
  ASSERT_TRUE(result.solved()) << result.reason;
  EXPECT_THAT(result.reason, HasSubstr("goal pose 2 of link link_6"));
}

TEST_F(PoseGoals, AvoidWhatStandsInTheNearestConfiguration) {
  add_goal(away());
  geometric::RobotState state(scene_.robots.front().model, scene_.robots.front().X_WB);
  state.set_configuration(away());
  add_box("at the elbow", state.link_pose(3).translation());
  const PlanningProblem problem = this->problem();
  ASSERT_FALSE(problem.goals.empty()) << problem.goal_fault;
  EXPECT_GT((problem.goal - away()).norm(), 0.5);
  const PlanResult result = planned(problem);
  ASSERT_TRUE(result.solved()) << result.reason;
  EXPECT_THAT(check_path(problem, result.path, 0.001).faults, IsEmpty());
}

TEST_F(PoseGoals, AreLookedForFarFromTheStartToo) {
  add_goal(away());
  scene_.goal_poses.front().rotation_tolerance.setConstant(std::numbers::pi);
  for (int boxes = 0; boxes < 40; ++boxes) {
    const PlanningProblem problem = this->problem();
    ASSERT_THAT(problem.goal_fault, IsEmpty()) << boxes << " boxes";
    geometric::RobotState state(scene_.robots.front().model, scene_.robots.front().X_WB);
    state.set_configuration(problem.goal);
    add_box("box " + std::to_string(boxes), state.link_pose(3).translation());
    scene_.objects.back().shape = geometric::Box{{0.02, 0.02, 0.02}};
  }
}

TEST_F(PoseGoals, SayWhatCollidesInAllConfigurations) {
  add_goal(away());
  add_box("block", flange(away()).translation());
  const PlanningProblem problem = this->problem();
  EXPECT_TRUE(problem.goals.empty());
  const PlanResult result = planned(problem);
  EXPECT_EQ(result.status, PlanStatus::kGoalInvalid);
  EXPECT_THAT(result.reason, AllOf(HasSubstr("The goal is in collision"), HasSubstr("link_6"),
                                   HasSubstr("block")));
}

TEST_F(PoseGoals, SayByHowMuchTheyAreMissed) {
  PoseGoal far;
  far.link = "link_6";
  far.X_WG.translation().x() = 3.0;
  scene_.goal_poses.push_back(far);
  const PlanResult result = planned(problem());
  EXPECT_EQ(result.status, PlanStatus::kGoalInvalid);
  EXPECT_THAT(result.reason, AllOf(HasSubstr("The goal is out of reach"),
                                   HasSubstr("misses goal pose of link"), HasSubstr(" mm and ")));
}

TEST_F(PoseGoals, MayBeMissedByTheirTolerance) {
  PoseGoal goal;
  goal.link = "link_6";
  goal.X_WG.translation() = Eigen::Vector3d(2.2, 0.0, 0.1625);  // the arm ends at 2.0
  goal.rotation_tolerance.setConstant(std::numbers::pi);
  scene_.goal_poses = {goal};
  EXPECT_TRUE(problem().goals.empty());
  scene_.goal_poses.front().position_tolerance = Eigen::Vector3d(0.3, 0.02, 0.02);
  const PlanningProblem problem = this->problem();
  ASSERT_FALSE(problem.goals.empty()) << problem.goal_fault;
  const Eigen::Vector3d p_W = flange(problem.goal).translation();
  EXPECT_NEAR(p_W.x(), 2.2, 0.3);
  EXPECT_NEAR(p_W.z(), 0.1625, 0.02);
}

TEST_F(PoseGoals, BringTheToolFrameThere) {
  add_goal(away());
  PoseGoal& goal = scene_.goal_poses.front();
  goal.X_LT = geometric::pose_from_rpy({0.0, 0.05, 0.1}, 0.2, 0.0, 0.0);
  goal.X_WG = goal.X_WG * goal.X_LT;
  EXPECT_TRUE(problem().goal.isApprox(away(), 1e-5));
}

TEST_F(PoseGoals, AreMissedByAPathThatEndsElsewhere) {
  add_goal(away());
  const PlanningProblem problem = this->problem();
  Configuration beside = away();
  beside[5] += 0.1;
  const PathCheckResult result = check_path(problem, {{start_, beside}}, 0.001);
  ASSERT_EQ(result.faults.size(), 1U);
  EXPECT_THAT(result.faults.front(),
              HasSubstr("The path's end misses goal pose of link link_6 by"));
  EXPECT_THAT(result.faults.front(), HasSubstr("5.73 degrees"));
}

TEST_F(PoseGoals, GiveTheSameBitsAgain) {
  add_goal(away());
  const PlanningProblem first = problem();
  const PlanningProblem second = problem();
  ASSERT_EQ(first.goals.size(), second.goals.size());
  for (std::size_t i = 0; i < first.goals.size(); ++i) {
    EXPECT_EQ(first.goals[i].q, second.goals[i].q);
  }
}

TEST_F(PoseGoals, ArePlannedToByADynamicRoadmap) {
  add_goal(away());
  DynamicRoadmap roadmap(problem());
  const PlanResult result = roadmap.plan({});
  ASSERT_TRUE(result.solved()) << result.reason;
  EXPECT_EQ(roadmap.source(), ReplanSource::kPlanner);
  EXPECT_THAT(check_path(roadmap.problem(), result.path, 0.001).faults, IsEmpty());
  scene_.start = away();
  EXPECT_FALSE(roadmap.follow(scene_)) << "its goals have to be solved again";
}

TEST_F(PoseGoals, FollowChangesOfTheScene) {
  add_goal(away());
  const PlanningProblem before = problem();
  add_box("block", flange(away()).translation());
  const PlanningProblem blocked =
      updated_problem(before, std::make_shared<const Scene>(scene_), nullptr);
  EXPECT_FALSE(blocked.goal_fault.empty());
  scene_.objects.pop_back();
  const PlanningProblem free =
      updated_problem(blocked, std::make_shared<const Scene>(scene_), nullptr);
  EXPECT_TRUE(free.goal_fault.empty());
  EXPECT_EQ(free.goals.size(), before.goals.size());
}

}  // namespace
}  // namespace handway::planning
