#include "handway/planning/core/planning_problem.h"

#include "handway/planning/core/select_joints.h"
#include "handway/planning/paths/path_check.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/timing/time_path.h"
#include "handway_test/input_errors.h"
#include "handway_test/planar_problems.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

using geometric::Scene;
using test::planar_configuration;
using test::refusal_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::shared_ptr<Scene> planar_scene() {
  auto scene = std::make_shared<Scene>(test::scene_of(test::planar_hand_arm()));
  scene->start = planar_configuration(-0.4, 0);
  scene->goal = planar_configuration(0.4, 0);
  return scene;
}

std::string refusal(const std::shared_ptr<Scene>& scene, const sampling::PmdBasis& basis) {
  return refusal_of([&] {
    static_cast<void>(make_problem(scene, std::make_shared<const sampling::PmdBasis>(basis)));
  });
}

PlanResult planned(const PlanningProblem& problem) {
  return PlannerRegistry().create("rrt-connect")->plan(problem, {});
}

/// Plans with every planner that needs no basis.
/// @param expect of the path that each finds.
void expect_of_every_path(const PlanningProblem& problem,
                          const std::function<void(const Path&)>& expect) {
  for (const std::string& name : PlannerRegistry().names()) {
    SCOPED_TRACE(name);
    const auto planner = PlannerRegistry().create(name);
    if (planner->capabilities().needs_basis) {
      continue;
    }
    const PlanResult result = planner->plan(problem, {.optimize_s = 0.2});
    ASSERT_TRUE(result.solved()) << result.reason;
    expect(result.path);
  }
}

/// A turning torso with a planar_hand_arm() at either side, all names of which begin with "l_" or
/// "r_".
geometric::RobotDescription two_armed_robot() {
  geometric::RobotDescription robot;
  robot.name = "two_armed";
  robot.links = {{"base", {}, {}}, {"torso", {}, {}}};
  geometric::Joint joint;
  joint.name = "torso";
  joint.type = geometric::JointType::kRevolute;
  joint.parent = "base";
  joint.child = "torso";
  joint.limits = {-1.0, 1.0};
  robot.joints = {joint};
  robot.groups = {{"arm", {"torso"}}, {"hand", {}}};
  for (const auto& [side, y] : {std::pair<std::string, double>("l_", 0.5), {"r_", -0.5}}) {
    geometric::RobotDescription part = test::planar_hand_arm();
    for (const geometric::Link& link : part.links) {
      robot.links.push_back({side + link.name, link.visual, link.collision});
    }
    for (geometric::Joint own : part.joints) {
      own.name = side + own.name;
      own.parent = side + own.parent;
      own.child = side + own.child;
      if (own.mimic) {
        own.mimic->joint = side + own.mimic->joint;
      }
      robot.joints.push_back(own);
    }
    joint.name = side + "shoulder_plate";
    joint.type = geometric::JointType::kFixed;
    joint.parent = "torso";
    joint.child = side + part.links.front().name;
    joint.X_PJ.translation().y() = y;
    robot.joints.push_back(joint);
    for (std::size_t g = 0; g < 2; ++g) {
      for (const std::string& own : part.groups[g].joints) {
        robot.groups[g].joints.push_back(side + own);
      }
    }
  }
  test::allow_neighbours(robot);
  return robot;
}

std::vector<std::string> joint_names(const PlanningProblem& problem,
                                     const std::vector<int>& variables) {
  std::vector<std::string> names;
  std::ranges::transform(variables, std::back_inserter(names),
                         [&](int v) { return problem.model().variable(v).name; });
  return names;
}

class TwoArmedRobot : public testing::Test {
 protected:
  TwoArmedRobot() { scene->start = scene->goal = scene->robots.front().configuration; }

  void set_goal(const std::string& joint, double value) {
    (*scene->goal)[*scene->robots.front().model->find_variable(joint)] = value;
  }

  std::shared_ptr<Scene> scene = std::make_shared<Scene>(test::scene_of(two_armed_robot()));
};

TEST_F(TwoArmedRobot, HasTwoMovableArmsWhateverTheGoalMoves) {
  set_goal("r_elbow", 0.5);
  const geometric::JointSelection joints = select_movable_joints(*scene, nullptr);
  EXPECT_EQ(joints.arm.size(), 5U);
  EXPECT_EQ(joints.hand.size(), 6U);
}

TEST_F(TwoArmedRobot, MovesTheArmAndHandThatTheGoalMoves) {
  set_goal("r_elbow", 0.5);
  const PlanningProblem problem = make_problem(scene, nullptr);
  EXPECT_THAT(joint_names(problem, problem.joints.arm),
              ElementsAre("torso", "r_shoulder", "r_elbow"));
  EXPECT_THAT(joint_names(problem, problem.joints.hand),
              ElementsAre("r_thumb", "r_left", "r_right"));
}

TEST_F(TwoArmedRobot, MovesBothArmsWhereTheGoalMovesBothOrNeither) {
  EXPECT_EQ(make_problem(scene, nullptr).joints.arm.size(), 5U);
  set_goal("torso", 0.2);
  EXPECT_EQ(make_problem(scene, nullptr).joints.hand.size(), 6U);
  set_goal("r_elbow", 0.5);
  set_goal("l_thumb", 0.5);
  EXPECT_EQ(make_problem(scene, nullptr).joints.arm.size(), 5U);
}

TEST_F(TwoArmedRobot, MovesTheArmWithTheLinkOfAGoalPose) {
  geometric::PoseGoal pose;
  pose.link = "l_palm";
  pose.X_WG.translation() = Eigen::Vector3d(0.5, 0.6, 0.0);
  scene->goal_poses = {pose};
  scene->goal.reset();
  const PlanningProblem problem = make_problem(scene, nullptr);
  EXPECT_THAT(joint_names(problem, problem.joints.arm),
              ElementsAre("torso", "l_shoulder", "l_elbow"));
}

TEST_F(TwoArmedRobot, MovesWhatItsGroupSays) {
  scene->group = {"arm"};
  set_goal("r_elbow", 0.5);
  EXPECT_EQ(make_problem(scene, nullptr).joints.arm.size(), 5U);
}

TEST_F(TwoArmedRobot, LeavesTheOtherArmWhereItIsAndAllowsPathsThatDoNot) {
  set_goal("r_shoulder", 1.0);
  set_goal("r_left", 1.0);
  const PlanningProblem problem = make_problem(scene, nullptr);
  const geometric::JointIndices& resting = problem.joints.fixed_limb_joints;
  EXPECT_EQ(resting.size(), 5U);
  expect_of_every_path(problem, [&](const Path& path) {
    for (const Configuration& q : path.waypoints) {
      EXPECT_EQ(q(resting), problem.start(resting));
    }
  });
  Path path;
  path.waypoints = {problem.start, problem.start, problem.goal};
  path.waypoints[1](resting).array() += 0.1;
  EXPECT_TRUE(check_path(problem, path, 0.01).valid());
}

TEST_F(TwoArmedRobot, TakesABasisForTheHandThatTheGoalMoves) {
  set_goal("r_elbow", 0.5);
  sampling::PmdBasis basis = test::planar_hand_basis();
  for (std::string& joint : basis.joints) {
    joint = "r_" + joint;
  }
  const PlanningProblem right =
      make_problem(scene, std::make_shared<const sampling::PmdBasis>(basis));
  EXPECT_TRUE(right.basis);
  EXPECT_EQ(right.joints.hand.size(), 3U);
  EXPECT_THAT(joint_names(right, right.joints.arm), ElementsAre("torso", "r_shoulder", "r_elbow"));
}

TEST(PlanningProblem, SplitsTheJointsOfArmAndHand) {
  sampling::PmdBasis basis = test::planar_hand_basis();
  std::swap(basis.joints[0], basis.joints[2]);  // the basis' order counts
  const PlanningProblem problem =
      make_problem(planar_scene(), std::make_shared<const sampling::PmdBasis>(basis));
  const auto& model = problem.model();
  EXPECT_EQ(problem.joints.arm, *model.find_group("arm"));
  const std::vector<int> hand = {*model.find_variable("right"), *model.find_variable("left"),
                                 *model.find_variable("thumb")};
  EXPECT_EQ(problem.joints.hand, hand);
}

TEST(PlanningProblem, TakesEveryJointForTheArmWithoutGroups) {
  geometric::RobotDescription robot = test::planar_hand_arm();
  robot.groups.clear();
  auto scene = std::make_shared<Scene>(test::scene_of(robot));
  scene->start = planar_configuration(-0.4, 0);
  scene->goal = planar_configuration(0.4, 0);
  const PlanningProblem alone = make_problem(scene, nullptr);
  EXPECT_EQ(alone.joints.arm.size(), 5U);
  EXPECT_TRUE(alone.joints.hand.empty());
  const PlanningProblem with_basis =
      make_problem(scene, std::make_shared<const sampling::PmdBasis>(test::planar_hand_basis()));
  EXPECT_EQ(with_basis.joints.arm.size(), 2U);
  EXPECT_EQ(with_basis.joints.hand.size(), 3U);
}

TEST(PlanningProblem, StartsWhereTheRobotStandsAndNeedsAGoal) {
  auto scene = planar_scene();
  scene->start.reset();
  scene->robots.front().configuration = planar_configuration(0.3, 0.1);
  EXPECT_EQ(make_problem(scene, nullptr).start, planar_configuration(0.3, 0.1));
  scene->goal.reset();
  EXPECT_THAT(refusal(scene, test::planar_hand_basis()), HasSubstr("goal"));
}

TEST(PlanningProblem, TakesAJointNextToItsLimitToBeAtIt) {
  auto scene = planar_scene();
  const double limit = scene->robots.front().model->upper()[0];
  scene->start = planar_configuration(0.3, 0.1);
  scene->goal = planar_configuration(limit + 5e-7, 0.1);
  const PlanningProblem rounded = make_problem(scene, nullptr);
  EXPECT_EQ(rounded.goal[0], limit);
  EXPECT_TRUE(rounded.warnings.empty());
  scene->goal = planar_configuration(limit + 8e-6, 0.1);
  const PlanningProblem beyond = make_problem(scene, nullptr);
  EXPECT_EQ(beyond.goal[0], limit);
  EXPECT_THAT(beyond.warnings, testing::ElementsAre(HasSubstr("The goal has joint shoulder at")));
  scene->goal = planar_configuration(limit + 2e-5, 0.1);
  EXPECT_EQ(make_problem(scene, nullptr).goal[0], limit + 2e-5);
}

TEST(PlanningProblem, WarnsOfAJointThatStaysOutOfItsLimits) {
  auto scene = planar_scene();
  scene->group = {"shoulder", "elbow"};
  Configuration start = planar_configuration(0.3, 0.1);
  const int left = *scene->robots.front().model->find_variable("left");
  start[left] = scene->robots.front().model->upper()[left] + 0.1;
  scene->start = start;
  scene->goal = start;
  (*scene->goal)[0] += 0.2;
  const PlanningProblem problem = make_problem(scene, nullptr);
  EXPECT_THAT(problem.warnings, testing::Contains(HasSubstr("joint left at 1.6")));
  const PlanResult result = planned(problem);
  ASSERT_TRUE(result.solved()) << result.reason;
  EXPECT_TRUE(check_path(problem, result.path, 0.001).valid());
  EXPECT_TRUE(time_path(problem, result.path, "motion").cleared());
}

TEST(PlanningProblem, LeavesWhatIsNotOfTheGroupAtTheStart) {
  auto scene = planar_scene();
  const auto basis = std::make_shared<const sampling::PmdBasis>(test::planar_hand_basis());
  scene->group = {"arm"};
  const PlanningProblem arm = make_problem(scene, basis);
  EXPECT_EQ(arm.joints.moving, *arm.model().find_group("arm"));
  EXPECT_EQ(arm.joints.arm, arm.joints.moving);
  EXPECT_EQ(arm.joints.fixed, *arm.model().find_group("hand"));
  EXPECT_TRUE(arm.joints.hand.empty());
  EXPECT_FALSE(arm.basis) << "of a hand that does not move";
  auto other = std::make_shared<Scene>(*scene);
  other->group = {"hand"};
  const PlanningProblem hand = updated_problem(arm, other, basis);
  EXPECT_TRUE(hand.joints.arm.empty());
  EXPECT_EQ(hand.joints.hand.size(), 3U);
  EXPECT_EQ(hand.basis, basis);
}

TEST(PlanningProblem, MovesNothingElseWhateverThePlanner) {
  PlanningProblem post = test::post_problem();
  auto scene = std::make_shared<Scene>(*post.scene);
  scene->start = post.start;
  scene->goal = post.goal;
  scene->group = {"arm", "left", "right"};
  const PlanningProblem problem = make_problem(scene, nullptr);
  const int thumb = *problem.model().find_variable("thumb");
  expect_of_every_path(problem, [&](const Path& path) {
    for (const Configuration& q : path.waypoints) {
      EXPECT_EQ(q[thumb], problem.start[thumb]);
    }
    EXPECT_TRUE(check_path(problem, path, 0.001).valid());
  });
  Path path;
  path.waypoints = {problem.start, problem.start, problem.goal};
  path.waypoints[1][thumb] += 0.1;
  EXPECT_THAT(check_path(problem, path, 0.01).faults,
              testing::Contains(AllOf(HasSubstr("Waypoint 2"), HasSubstr("joint thumb moves"))));
}

TEST(PlanningProblem, RefusesAGoalThatMovesWhatDoesNot) {
  auto scene = planar_scene();
  scene->group = {"arm"};
  scene->goal = planar_configuration(0.4, 0, 0.2, 0.1, 0);
  const PlanResult result = planned(make_problem(scene, nullptr));
  EXPECT_EQ(result.status, PlanStatus::kGoalInvalid);
  EXPECT_THAT(result.reason, HasSubstr("The goal moves thumb and 1 other joint, which the group "
                                       "(arm) leaves at the start"));
  scene->goal = planar_configuration(0.4, 0, 1e-9, 0, 0);
  EXPECT_TRUE(planned(make_problem(scene, nullptr)).solved()) << "a file's rounding";
}

TEST(PlanningProblem, RefusesTheBasisOfAnotherHand) {
  sampling::PmdBasis basis = test::planar_hand_basis();
  basis.hand = "claw";
  basis.joints[1] = "pinky";
  EXPECT_THAT(refusal(planar_scene(), basis),
              AllOf(HasSubstr("\"pinky\""), HasSubstr("planar"), HasSubstr("claw")));
}

TEST(MovableJoints, LeaveOutThoseOfABasisThatTheRobotLacks) {
  const std::shared_ptr<Scene> scene = planar_scene();
  sampling::PmdBasis basis = test::planar_hand_basis();
  basis.joints[1] = "pinky";
  EXPECT_THAT(select_movable_joints(*scene, &basis).hand, ElementsAre(2, 4)) << "thumb and right";
  scene->group = {"arm"};
  const geometric::JointSelection of_arm = select_movable_joints(*scene, &basis);
  EXPECT_THAT(of_arm.arm, ElementsAre(0, 1));
  EXPECT_TRUE(of_arm.hand.empty());
  EXPECT_THAT(of_arm.fixed, ElementsAre(2, 3, 4));
}

TEST(PlanningProblem, MeasuresInNormalisedJoints) {
  const PlanningProblem problem = make_problem(planar_scene(), nullptr);
  EXPECT_NEAR(normalised_distance(problem.model(), planar_configuration(-2.5, 0),
                                  planar_configuration(2.5, 0)),
              1.0, 1e-12);
  EXPECT_NEAR(normalised_distance(problem.model(), planar_configuration(0, 0, -1.2, 0, 0),
                                  planar_configuration(0, 0, 1.2, 1.5, 0)),
              std::sqrt(2.0), 1e-12);
}

TEST(PlanningQuery, NamesWhatAStartCollidesWith) {
  PlanningProblem problem = test::post_problem();
  problem.start = planar_configuration(0.07, 0);
  const PlanResult result = planned(problem);
  EXPECT_EQ(result.status, PlanStatus::kStartInvalid);
  EXPECT_THAT(result.reason,
              AllOf(HasSubstr("start is in collision"), HasSubstr("right_tip with post")));
  EXPECT_TRUE(result.path.empty());
}

TEST(PlanningQuery, NamesTheJointOfAGoalOutOfLimits) {
  PlanningProblem problem = test::open_problem();
  problem.goal = planar_configuration(0.1, 2.6);
  const PlanResult result = planned(problem);
  EXPECT_EQ(result.status, PlanStatus::kGoalInvalid);
  EXPECT_THAT(result.reason, AllOf(HasSubstr("goal is out of limits"), HasSubstr("joint elbow"),
                                   HasSubstr("2.6"), HasSubstr("2.5")));
}

TEST(PlanningQuery, NamesTheCoupledJointOfAGoalThatPutsItOutOfItsOwnLimits) {
  geometric::RobotDescription robot = test::planar_hand_arm();
  std::ranges::find(robot.joints, "left_tip", &geometric::Joint::name)->limits.upper = 0.4;
  const PlanningProblem problem =
      test::planar_problem(test::scene_of(std::move(robot)), planar_configuration(0.1, 0.2),
                           planar_configuration(0.1, 0.2, 0.0, 1.0, 0.0));
  const PlanResult result = planned(problem);
  EXPECT_EQ(result.status, PlanStatus::kGoalInvalid);
  EXPECT_THAT(result.reason, AllOf(HasSubstr("joint left_tip at 0.5"), HasSubstr("0.4"),
                                   HasSubstr("follows left")));
  Path path;
  path.waypoints = {problem.start, problem.goal};
  EXPECT_THAT(check_path(problem, path, 0.01).faults,
              testing::Contains(AllOf(HasSubstr("Waypoint 2"), HasSubstr("left_tip"))));
}

TEST(PlanningQuery, RefusesWhatIsNoNumber) {
  for (const double value : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    PlanningProblem problem = test::open_problem();
    problem.start[1] = value;
    const PlanResult result = planned(problem);
    EXPECT_EQ(result.status, PlanStatus::kStartInvalid);
    EXPECT_THAT(result.reason, HasSubstr("no number for joint"));
  }
}

TEST(PlanningQuery, RefusesAConfigurationOfAnotherRobot) {
  PlanningProblem problem = test::open_problem();
  problem.goal = Eigen::Vector3d(0, 0, 0);
  const PlanResult result = planned(problem);
  EXPECT_EQ(result.status, PlanStatus::kGoalInvalid);
  EXPECT_THAT(result.reason, HasSubstr("3 values where the robot has 5"));
}

TEST(PlanningQuery, ForgivesTheRoundingsOfAFile) {
  PlanningProblem problem = test::open_problem();
  problem.goal = planar_configuration(0.1, 0.2, 0.0, -1e-10, 0.0);
  EXPECT_TRUE(planned(problem).solved());
}

TEST(PlanningRequest, RefusesThreadsAndResolutionsThatMakeNoSense) {
  const auto planner = PlannerRegistry().create("rrt-connect");
  const PlanningProblem problem = test::open_problem();
  PlanRequest no_thread;
  no_thread.threads = 0;
  PlanRequest too_exact;
  too_exact.resolution = 0.0;
  PlanRequest not_a_number;
  not_a_number.resolution = std::nan("");
  for (const PlanRequest& request : {no_thread, too_exact, not_a_number}) {
    EXPECT_THROW(static_cast<void>(planner->plan(problem, request)), std::invalid_argument);
  }
}

TEST(PlanningRequest, NeedsABasisForPrincipalDirections) {
  PlanningProblem problem = test::open_problem();
  problem.basis = nullptr;
  EXPECT_THAT(refusal_of([&] {
                static_cast<void>(PlannerRegistry().create("pmd-prm")->plan(problem, {}));
              }),
              AllOf(HasSubstr("hand_basis"), HasSubstr("pmd-prm")));
}

}  // namespace
}  // namespace handway::planning
