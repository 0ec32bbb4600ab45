/// The hand of the shipped scene on arms of other makers, without closed-form inverse kinematics:
/// pre-grasps of the can, paths to them, and the corridor of tool poses.
#include "handway/planning/grasps/pregrasp_search.h"
#include "handway/planning/paths/path_check.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/spaces/state_space.h"
#include "handway_test/known_problems.h"
#include "handway_test/robots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <utility>

namespace handway::planning {
namespace {

using geometric::Joint;
using geometric::Link;
using geometric::RobotDescription;
using geometric::RobotModel;
using testing::IsEmpty;

PlanningProblem can_on_table() {
  for (const test::KnownProblem& known : test::known_problems()) {
    if (known.name == "can_on_table") {
      const SceneState scene = test::load(known);
      return make_problem(scene.scene, scene.basis);
    }
  }
  throw std::runtime_error("no scene can_on_table");
}

/// `arm` with the hand that `model` has below `palm` at its last link.
RobotDescription with_hand(RobotDescription arm, const RobotModel& model, int palm) {
  const std::string mount = arm.links.back().name;
  std::set<std::string> of_hand;
  for (int i = palm; i < model.link_count(); ++i) {
    if (i == palm || of_hand.contains(model.link(model.parent(i)).name)) {
      of_hand.insert(model.link(i).name);
      arm.links.push_back(model.link(i));
      arm.joints.push_back(model.joint(i));
      if (i == palm) {
        arm.joints.back().parent = mount;
      }
    }
  }
  arm.allowed_collisions = model.description().allowed_collisions;
  return arm;
}

/// Plans to the first pre-grasp of the can with one of the arms.
class ArmsWithHands : public testing::TestWithParam<const char*> {
 protected:
  ArmsWithHands() {
    const std::string name = GetParam();
    const RobotDescription arm = name == "ur5e"    ? test::ur5e()
                                 : name == "panda" ? test::panda_arm()
                                                   : test::iiwa14();
    const PlanningProblem shipped = can_on_table();
    const int palm = shipped.hand.palm;
    geometric::Scene scene = *shipped.scene;
    geometric::RobotInstance& robot = scene.robots.front();
    robot.model = std::make_shared<const RobotModel>(with_hand(arm, shipped.model(), palm));
    Configuration q = robot.model->neutral();
    const auto set = [&](const char* joint, double value) {
      q[robot.model->find_variable(joint).value()] = value;
    };
    set("joint_2", name == "ur5e" ? -1.8 : -0.4);
    set("joint_3", name == "ur5e" ? 1.6 : 0.0);
    set("joint_4", name == "panda" ? -2.0 : 1.2);
    set("joint_5", name == "ur5e" ? 1.3 : 0.2);
    for (const int v : shipped.joints.hand) {
      set(shipped.model().variable(v).name.c_str(), shipped.start[v]);
    }
    robot.configuration = q;
    scene.start = q;
    scene.goal = q;
    scene.constraints.clear();
    scene.postures.clear();
    problem_ =
        make_problem(std::make_shared<const geometric::Scene>(std::move(scene)), shipped.basis);
  }

  PlanningProblem problem_;
};

TEST_P(ArmsWithHands, GraspAndPlanInTheCorridorsOfJointsAndToolPoses) {
  ASSERT_FALSE(has_closed_form_kinematics(problem_));
  PregraspOptions options;
  options.samples = 6000;
  const std::vector<Pregrasp> grasps = find_pregrasps(problem_, "can", options).found;
  ASSERT_FALSE(grasps.empty());
  const auto checker = problem_.checker->clone();
  for (const Pregrasp& grasp : grasps) {
    EXPECT_FALSE(checker->first_collision(grasp.q));
    EXPECT_GE(grasp.fingers, 2);
  }
  problem_.set_goal(grasps.front().q);
  const PlannerRegistry planners;
  const auto expect_path = [&](const char* name, const char* corridor) {
    const auto planner = planners.create(name);
    if (corridor != nullptr) {
      planner->set_parameter("corridor", corridor);
    }
    const PlanResult result = planner->plan(problem_, {.time_limit_s = 120.0});
    EXPECT_TRUE(result.solved()) << name << ": " << result.reason;
    if (result.solved()) {
      EXPECT_THAT(check_path(problem_, result.path, 0.001).faults, IsEmpty()) << name;
    }
  };
  expect_path("auto", nullptr);
  expect_path("pmd-rrt-connect", "cartesian");
  expect_path("pmd-prm", "cartesian");
}

INSTANTIATE_TEST_SUITE_P(OtherMakers, ArmsWithHands, testing::Values("ur5e", "panda", "iiwa14"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace handway::planning
