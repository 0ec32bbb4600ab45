/// Contract of every planner with robots that are no hand on an arm, whatever its settings: it
/// plans, or its message says what it needs.
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/paths/path_check.h"
#include "handway/planning/planners/planner.h"
#include "handway_test/input_errors.h"
#include "handway_test/planar_problems.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace handway::planning {
namespace {

using geometric::Joint;
using geometric::RobotDescription;
using geometric::RobotModel;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const PlannerRegistry& registry() {
  static const PluginManager kExtensions = [] {
    PluginManager plugins;
    plugins.load_plugins(HANDWAY_PLUGINS);
    return plugins;
  }();
  return kExtensions.planners();
}

/// The planar robot with other groups, and with these joints fixed.
RobotDescription planar(std::vector<geometric::JointGroup> groups,
                        const std::vector<std::string>& fixed) {
  RobotDescription robot = test::planar_hand_arm();
  robot.groups = std::move(groups);
  for (Joint& joint : robot.joints) {
    const std::string& moved_by = joint.mimic ? joint.mimic->joint : joint.name;
    if (std::ranges::count(fixed, moved_by) > 0) {
      joint.type = geometric::JointType::kFixed;
      joint.mimic.reset();
    }
  }
  return robot;
}

constexpr double kReach = 0.4;  // of the joints' ranges, from start to goal

/// Returns a problem from near the middle of all ranges to 0.4 of them away, past a post, free at
/// both ends.
PlanningProblem problem_of(RobotDescription robot, bool has_basis) {
  geometric::Scene scene = test::scene_of(std::move(robot));
  test::add_object(scene, "post", geometric::Cylinder{0.03, 0.3}, Eigen::Vector3d(-0.5, 0.0, 0.0));
  const RobotModel& model = *scene.robots.front().model;
  scene.start = model.neutral();
  scene.goal = model.neutral();
  for (int v = 0; v < model.variable_count(); ++v) {
    (*scene.goal)[v] += kReach * (model.upper()[v] - model.neutral()[v]);
  }
  return make_problem(
      std::make_shared<const geometric::Scene>(std::move(scene)),
      has_basis ? std::make_shared<const sampling::PmdBasis>(test::planar_hand_basis()) : nullptr);
}

struct OddRobot {
  const char* name;
  PlanningProblem (*make)();
};

const std::vector<std::string> kArm = {"shoulder", "elbow"};
const std::vector<std::string> kHand = {"thumb", "left", "right"};

const OddRobot kHandAlone = {"HandAlone", [] {
                               return problem_of(planar({{"hand", kHand}}, kArm), true);
                             }};

const std::vector<OddRobot> kOddRobots = {
    kHandAlone,
    {"HandWithAnEmptyArm",
     [] {
       return problem_of(planar({{"arm", {}}, {"hand", kHand}}, kArm), true);
     }},
    {"HandWithAnArmOfFixedJoints",
     [] {
       return problem_of(planar({{"arm", kArm}, {"hand", kHand}}, kArm), true);
     }},
    {"HandWithoutABasis",
     [] {
       return problem_of(planar({{"hand", kHand}}, kArm), false);
     }},
    {"ArmAlone",
     [] {
       return problem_of(planar({{"arm", kArm}}, kHand), false);
     }},
    {"ArmWithAnEmptyHand",
     [] {
       return problem_of(planar({{"arm", kArm}, {"hand", {}}}, kHand), false);
     }},
    {"EmptyArmGroup",
     [] {
       return problem_of(planar({{"arm", {}}, {"hand", kHand}}, {}), true);
     }},
    {"NoGroups", [] { return problem_of(planar({}, {}), true); }},
    {"ArmThatHoldsTheHand",
     [] {
       return problem_of(planar({{"arm", {"shoulder", "elbow", "left"}}, {"hand", kHand}}, {}),
                         true);
     }},
    {"ArmOfOneJoint",
     [] {
       return problem_of(planar({{"arm", {"elbow"}}}, kHand), false);
     }},
    {"JointWithoutRange",
     [] {
       RobotDescription robot = planar({{"arm", kArm}, {"hand", kHand}}, {});
       const auto elbow = std::ranges::find(robot.joints, "elbow", &Joint::name);
       elbow->limits.lower = elbow->limits.upper = 0.1;
       return problem_of(std::move(robot), true);
     }},
    {"NothingThatMoves",
     [] {
       return problem_of(planar({{"arm", kArm}}, {"shoulder", "elbow", "thumb", "left", "right"}),
                         false);
     }},
};

/// Returns every setting that is a choice or on or off, with each of its values; the first is that
/// nothing is set.
std::vector<std::pair<std::string, std::string>> choices_of(Planner& planner) {
  std::vector<std::pair<std::string, std::string>> choices = {{"", ""}};
  for (const geometric::Parameter& parameter : planner.parameters()) {
    if (const auto* choice = std::get_if<geometric::Choice>(&parameter.value)) {
      for (const std::string& option : choice->options) {
        choices.emplace_back(parameter.key, option);
      }
    } else if (std::holds_alternative<bool>(parameter.value)) {
      choices.emplace_back(parameter.key, "true");
      choices.emplace_back(parameter.key, "false");
    }
  }
  return choices;
}

std::unique_ptr<Planner> planner_with(const std::string& name,
                                      const std::pair<std::string, std::string>& choice) {
  std::unique_ptr<Planner> planner = registry().create(name);
  planner->set_parameter("max_samples", "2000");
  if (!choice.first.empty()) {
    planner->set_parameter(choice.first, choice.second);
  }
  return planner;
}

/// Returns the planner's result for the problem; nothing if it refused it with a message.
std::optional<PlanResult> outcome(Planner& planner, const PlanningProblem& problem) {
  std::optional<PlanResult> result;
  const std::string refusal = test::refusal_of([&] { result = planner.plan(problem, {}); });
  EXPECT_TRUE(result || refusal.size() > 20) << refusal;
  return result;
}

class OddRobots : public testing::TestWithParam<std::tuple<std::string, OddRobot>> {};

TEST_P(OddRobots, ArePlannedForOrRefusedInWords) {
  const PlanningProblem problem = std::get<1>(GetParam()).make();
  const std::string& name = std::get<0>(GetParam());
  for (const auto& choice : choices_of(*registry().create(name))) {
    SCOPED_TRACE(choice.first + "=" + choice.second);
    const std::optional<PlanResult> result = outcome(*planner_with(name, choice), problem);
    if (!result) {
      continue;
    }
    EXPECT_THAT(result->reason, Not(IsEmpty()));
    if (result->solved()) {
      EXPECT_THAT(check_path(problem, result->path, 0.005).faults, IsEmpty());
    }
  }
}

std::string word_of(std::string name) {
  std::ranges::replace_if(
      name, [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Planners, OddRobots,
                         testing::Combine(testing::ValuesIn(registry().names()),
                                          testing::ValuesIn(kOddRobots)),
                         [](const auto& test) {
                           return word_of(std::get<0>(test.param)) + "_" +
                                  std::get<1>(test.param).name;
                         });

class HandAlone : public testing::TestWithParam<std::string> {};

TEST_P(HandAlone, IsPlannedForWithTheDefaults) {
  if (GetParam() == "ompl-pmd-fmt") {
    GTEST_SKIP() << "it draws all samples at once, and finds no path among them here";
  }
  const PlanningProblem problem = kHandAlone.make();
  const PlanResult result = planner_with(GetParam(), {"max_samples", "50000"})->plan(problem, {});
  EXPECT_TRUE(result.solved()) << result.reason;
}

INSTANTIATE_TEST_SUITE_P(Planners, HandAlone, testing::ValuesIn(registry().names()),
                         [](const auto& test) { return word_of(test.param); });

TEST(HandAlone, HasNoToolToPlanWith) {
  for (const std::string name : {"pmd-prm", "full-prm", "pmd-rrt-connect", "pmd-lazy"}) {
    const auto planner = planner_with(name, {"corridor", "cartesian"});
    EXPECT_THAT(test::refusal_of([&] { static_cast<void>(planner->plan(kHandAlone.make(), {})); }),
                testing::AllOf(HasSubstr("planar"), HasSubstr("no arm"), HasSubstr("joint")))
        << name;
  }
}

TEST(EmptyArmGroup, SaysNothing) {
  const PlanningProblem problem = problem_of(planar({{"arm", {}}, {"hand", kHand}}, {}), true);
  const RobotModel& model = problem.model();
  EXPECT_EQ(problem.joints.arm,
            (std::vector{*model.find_variable("shoulder"), *model.find_variable("elbow")}));
}

}  // namespace
}  // namespace handway::planning
