#include "handway/planning/tasks/task.h"

#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/setup/placing.h"
#include "handway/planning/core/carried_objects.h"
#include "handway/planning/edits/scene_edits.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/grasps/given_grasps.h"
#include "handway/planning/grasps/grasp_file.h"
#include "handway/planning/paths/path_check.h"
#include "handway/planning/tasks/palm_line.h"
#include "handway/planning/tasks/task_file.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace handway::planning {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

SceneState shipped(const std::string& name) {
  return load_scene(test::source_dir() / "scenes" / (name + ".yaml"), PluginManager());
}

TaskPlan plan(const SceneState& state, const Task& task, const TaskOptions& options = {},
              const std::stop_token& stop = {}) {
  const PlannerRegistry planners;
  const auto planner = planners.create("auto");
  return plan_task(state, task, *planner, options, stop);
}

std::vector<std::string> kinds(const TaskPlan& plan) {
  std::vector<std::string> names;
  for (const TaskStage& stage : plan.stages) {
    names.emplace_back(to_string(stage.kind));
  }
  return names;
}

// Every stage begins where the one before ends, and is valid in its scene by the meshes alone.
void expect_valid(const TaskPlan& plan, const SceneState& begin) {
  Configuration q = begin.scene->start.value();
  for (const TaskStage& stage : plan.stages) {
    SCOPED_TRACE(to_string(stage.kind));
    EXPECT_EQ(stage.path.waypoints.front(), q);
    q = stage.path.waypoints.back();
    const PlanningProblem problem = make_problem(stage.state.scene, stage.state.basis);
    const PathCheckResult checked = check_path(problem, stage.path, 0.002);
    EXPECT_THAT(checked.faults, ::testing::IsEmpty());
    EXPECT_THAT(checked.warnings, ::testing::IsEmpty()) << "the fingers hold what they carry";
    EXPECT_EQ(carried_objects(*stage.state.scene).size(), stage.carried.empty() ? 0U : 1U);
  }
}

TEST(Tasks, PickACanAndPlaceItElsewhereOnTheTable) {
  const SceneState scene = shipped("can_on_table");
  const Task task{PickStep{"can"}, PlaceStep{{"table"}}, MoveStep{*scene.scene->start, "start"}};
  const TaskPlan plan = planning::plan(scene, task);
  ASSERT_TRUE(plan.solved) << plan.reason;
  EXPECT_THAT(kinds(plan), ::testing::ElementsAre("approach", "reach", "close", "lift", "carry",
                                                  "lower", "open", "retreat", "move"));
  expect_valid(plan, scene);
  const geometric::Scene& last = *plan.stages.back().state.scene;
  const geometric::SceneObject& can = *geometric::find_object(last, "can");
  EXPECT_FALSE(can.attachment);
  EXPECT_NEAR(*gap_to_support(last, can), geometric::kRestingGap, 1e-6);
  EXPECT_FALSE(can.X_PO.isApprox(geometric::find_object(*scene.scene, "can")->X_PO, 0.01));
  EXPECT_GT(plan.stages[2].squeezed.size(), 0) << "what the hand holds it with";
}

TEST(Tasks, RestWithTheObjectInTheHand) {
  const SceneState scene = shipped("can_on_table");
  const TaskPlan plan = planning::plan(
      scene, {PickStep{"can"}, WaitStep{2.5}, OutputStep{"do3", true}, PlaceStep{{"table"}}});
  ASSERT_TRUE(plan.solved) << plan.reason;
  ASSERT_THAT(kinds(plan), ::testing::ElementsAre("approach", "reach", "close", "lift", "wait",
                                                  "output", "carry", "lower", "open", "retreat"));
  expect_valid(plan, scene);
  EXPECT_EQ(plan.stages[4].rest, 2.5);
  EXPECT_EQ(plan.stages[4].carried, "can");
  EXPECT_EQ(plan.stages[5].rest, 0.0);
  EXPECT_EQ(plan.stages[5].path.waypoints.front(), plan.stages[3].path.waypoints.back());
}

TEST(Tasks, LeaveOutDisabledSteps) {
  const SceneState scene = shipped("can_on_table");
  const auto off = [](geometric::ProgramStep step) {
    step.disabled = true;
    return step;
  };
  const geometric::Program program{
      "",
      {off(PickStep{"no such object"}), WaitStep{1.0},
       geometric::AlternativesStep{{{"", {off(WaitStep{2.0})}}, {"", {WaitStep{3.0}}}}},
       geometric::AlternativesStep{{{"", {off(WaitStep{4.0})}}, {"", {off(WaitStep{5.0})}}}}}};
  const Task task = task_of(program, *scene.scene);
  ASSERT_EQ(task.size(), 3U);
  EXPECT_EQ(to_string(task[0]), "wait 1 s");
  EXPECT_THAT(std::get<FirstOfStep>(task[1]).lengths, ::testing::ElementsAre(1U));
  EXPECT_EQ(to_string(task[2]), "wait 3 s");
  const Task none = task_of({"", {off(WaitStep{1.0})}}, *scene.scene);
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(plan(scene, none)); }),
              HasSubstr("at least one that is not disabled"));
}

TEST(Tasks, PlaceAtAPose) {
  const SceneState scene = shipped("can_on_table");
  PlaceStep place;
  place.pose = geometric::find_object(*scene.scene, "can")->X_PO;
  place.pose->pretranslate(Eigen::Vector3d(-0.05, 0.12, geometric::kRestingGap));
  const TaskPlan plan = planning::plan(scene, {PickStep{"can"}, place});
  ASSERT_TRUE(plan.solved) << plan.reason;
  expect_valid(plan, scene);
  EXPECT_TRUE(geometric::find_object(*plan.stages.back().state.scene, "can")
                  ->X_PO.isApprox(*place.pose, 1e-4));
  place.supports = {"table"};
  place.pose = geometric::find_object(*scene.scene, "table")->X_PO.inverse() * *place.pose;
  const TaskPlan on_table = planning::plan(scene, {PickStep{"can"}, place});
  ASSERT_TRUE(on_table.solved) << on_table.reason;
  EXPECT_TRUE(geometric::find_object(*on_table.stages.back().state.scene, "can")
                  ->X_PO.isApprox(
                      geometric::find_object(*plan.stages.back().state.scene, "can")->X_PO, 1e-6))
      << "the same place in another frame";
}

TEST(Tasks, PlaceOnTheFirstSupportThatIsPossible) {
  geometric::SceneObject brick;
  brick.name = "brick";
  brick.shape = geometric::Box{Eigen::Vector3d::Constant(0.02)};
  brick.X_PO.translation() = Eigen::Vector3d(0.5, 2.0, 0.5);
  const SceneState scene = with_object(shipped("can_on_table"), brick);
  const TaskPlan plan = planning::plan(scene, {PickStep{"can"}, PlaceStep{{"brick", "table"}}});
  ASSERT_TRUE(plan.solved) << plan.reason;
  expect_valid(plan, scene);
  const auto lowering = std::ranges::find(plan.trials, StageKind::kLower, &StageTrials::kind);
  EXPECT_EQ(lowering->reason, "No face of brick is large enough for can");
}

// The box around an object that stands in the world.
Eigen::AlignedBox3d box_around(const geometric::SceneObject& object) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : geometric::tessellate(object.shape)->vertices) {
    box.extend(object.X_PO * p);
  }
  return box;
}

Eigen::Vector3d foot_of(const geometric::SceneObject& object) {
  const Eigen::AlignedBox3d box = box_around(object);
  return {box.center().x(), box.center().y(), box.min().z()};
}

// A frame on the table's top, aside of the can.
geometric::NamedFrame place_on_table(const geometric::Scene& scene) {
  const geometric::SceneObject& can = *geometric::find_object(scene, "can");
  const Eigen::Vector3d place = foot_of(can) + Eigen::Vector3d(-0.05, 0.12, 0.0) -
                                gap_to_support(scene, can).value() * Eigen::Vector3d::UnitZ();
  return {"place", "table",
          geometric::find_object(scene, "table")->X_PO.inverse() *
              geometric::Pose(Eigen::Translation3d(place))};
}

TEST(Tasks, PlaceInAFrameAndMoveToPosesAndAlongLines) {
  const SceneState scene =
      with_frame(shipped("can_on_table"), place_on_table(*shipped("can_on_table").scene));
  PoseStep above;
  above.goal.link = "palm";
  above.goal.reference = "can";
  const geometric::Pose X_WP = *link_pose(*scene.scene, scene.scene->start.value(),
                                          scene.scene->robots.front().name, "palm");
  above.goal.X_WG = geometric::find_object(*scene.scene, "can")->X_PO.inverse() * X_WP;
  const Task task{PickStep{"can"}, LineStep{{0.0, 0.05, 0.0}}, PlaceStep{{"place"}}, above,
                  LineStep{{0.0, 0.0, 0.03}, "table"}};
  const TaskPlan plan = planning::plan(scene, task);
  ASSERT_TRUE(plan.solved) << plan.reason;
  expect_valid(plan, scene);
  EXPECT_THAT(kinds(plan), ::testing::IsSupersetOf({"line", "lower", "move"}));
  const geometric::Scene& last = *plan.stages.back().state.scene;
  const geometric::Pose X_WO = geometric::find_object(last, "can")->X_PO;
  const geometric::Pose X_WF = *geometric::standing_pose(last, "place");
  EXPECT_NEAR(*gap_to_support(last, *geometric::find_object(last, "can")), geometric::kRestingGap,
              1e-4);
  const Eigen::Vector3d off = foot_of(*geometric::find_object(last, "can")) - X_WF.translation();
  EXPECT_LT((off - geometric::kRestingGap * Eigen::Vector3d::UnitZ()).norm(), 1e-3);
  const auto palm_at_end = [&](const TaskStage& stage) {
    return *link_pose(last, stage.path.waypoints.back(), last.robots.front().name, "palm");
  };
  const auto moved = std::ranges::find(plan.stages, 3U, &TaskStage::step);
  ASSERT_NE(moved, plan.stages.end());
  EXPECT_TRUE(palm_at_end(*moved).isApprox(X_WO * above.goal.X_WG, 1e-3))
      << "relative to where the can is then";
  const Eigen::Vector3d way =
      palm_at_end(plan.stages.back()).translation() - palm_at_end(*moved).translation();
  EXPECT_LT((way - Eigen::Vector3d(0.0, 0.0, 0.03)).norm(), 1e-3);
  EXPECT_LE(plan.stages.back().deviation, kLineDeviation);
}

TEST(Tasks, TryAlternatives) {
  const SceneState scene = shipped("can_on_table");
  PlaceStep far;
  far.pose = geometric::Pose(Eigen::Translation3d(5.0, 0.0, 1.0));
  const Task task{
      PickStep{"can"},      FirstOfStep{{2, 1}, "far or near"},    LineStep{{0.0, 0.0, 0.02}}, far,
      PlaceStep{{"table"}}, MoveStep{*scene.scene->start, "start"}};
  const TaskPlan plan = planning::plan(scene, task, {.grasps = {.most = 2}});
  ASSERT_TRUE(plan.solved) << plan.reason;
  expect_valid(plan, scene);
  EXPECT_THAT(plan.stages, Not(::testing::Contains(::testing::Field(&TaskStage::step, 2U))))
      << "the first list ends in a place that is too far away";
  EXPECT_THAT(plan.stages, ::testing::Contains(::testing::Field(&TaskStage::step, 4U)));
  EXPECT_EQ(plan.stages.back().step, 5U);
}

TEST(Tasks, TellTheStageThatFails) {
  const SceneState scene = shipped("can_on_table");
  PlaceStep far;
  far.pose = geometric::Pose(Eigen::Translation3d(5.0, 0.0, 1.0));
  const TaskPlan plan = planning::plan(scene, {PickStep{"can"}, far}, {.grasps = {.most = 2}});
  EXPECT_FALSE(plan.solved);
  EXPECT_THAT(plan.stages, ::testing::IsEmpty());
  EXPECT_THAT(plan.reason, StartsWith("Step 2, place: in the stage \"lower\""));
  EXPECT_THAT(plan.reason, HasSubstr("The arm does not reach the place."));
}

// The scene with grasps of the can as those that it keeps: the last one found first.
SceneState with_kept_grasps(const SceneState& state, const std::filesystem::path& file) {
  const PlanningProblem problem = make_problem(state.scene, state.basis, {}, GoalNeed::kOptional);
  Pregrasps grasps = find_pregrasps(problem, "can", {.most = 3});
  std::ranges::reverse(grasps.found);
  std::ofstream(file) << grasp_file_text(problem, "can", {}, grasps);
  return with_grasps(state, "can", file);
}

TEST(Tasks, PickWithTheGraspsThatTheSceneKeeps) {
  const test::ScratchFolder folder;
  const SceneState scene = with_kept_grasps(shipped("can_on_table"), folder.path() / "grasps.yaml");
  const TaskPlan plan = planning::plan(scene, {PickStep{"can"}});
  ASSERT_TRUE(plan.solved) << plan.reason;
  expect_valid(plan, scene);
  const PlanningProblem problem = make_problem(scene.scene, scene.basis, {}, GoalNeed::kOptional);
  const MeasuredGrasps kept = measure_given_grasps(
      problem, "can", read_given_grasps(folder.path() / "grasps.yaml", problem, "can"));
  const auto close = std::ranges::find(plan.stages, StageKind::kClose, &TaskStage::kind);
  EXPECT_EQ(close->path.waypoints.back(), kept.grasps.found.front().closed)
      << "the first of the file";
}

TEST(Tasks, SearchForGraspsIfThoseOfTheSceneAreNotPossible) {
  const test::ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "grasps.yaml";
  std::ofstream(file) << "- {pose: [9, 0, 0, 0, 0, 0, 1], joints: {}}\n";
  const TaskPlan plan =
      planning::plan(with_grasps(shipped("can_on_table"), "can", file), {PickStep{"can"}});
  ASSERT_TRUE(plan.solved) << plan.reason;
  const auto closing = std::ranges::find(plan.trials, StageKind::kClose, &StageTrials::kind);
  ASSERT_NE(closing, plan.trials.end());
  EXPECT_THAT(closing->reason, HasSubstr("grasps.yaml:1: the arm does not get there."));
}

TEST(Tasks, RefuseAFileOfGraspsThatCannotBeRead) {
  const test::ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "grasps.yaml";
  std::ofstream(file) << "- {pose: [9, 0, 0, 0, 0, 0, 1], joints: {no_such_joint: 1}}\n";
  EXPECT_THAT(test::refusal_of(
                  [&] { static_cast<void>(with_grasps(shipped("can_on_table"), "can", file)); }),
              HasSubstr("no_such_joint"));
}

TEST(Tasks, SayThatTheStartCollides) {
  SceneState state = shipped("can_on_table");
  geometric::Scene scene = *state.scene;
  scene.objects.back().X_PO =
      *link_pose(scene, scene.start.value(), scene.robots.front().name, "palm");
  state.scene = std::make_shared<const geometric::Scene>(scene);
  const TaskPlan plan = planning::plan(state, {PickStep{"can"}});
  EXPECT_FALSE(plan.solved);
  EXPECT_FALSE(plan.start_is_valid);
  EXPECT_THAT(plan.reason, StartsWith("The start is not valid: "));
  EXPECT_THAT(plan.reason, HasSubstr(" and can collide"));
}

TEST(Tasks, RefuseStepsThatCannotFollowEachOther) {
  const SceneState scene = shipped("can_on_table");
  const auto refusal = [&](const Task& task) {
    return test::refusal_of([&] { static_cast<void>(plan(scene, task)); });
  };
  EXPECT_THAT(refusal({}), HasSubstr("no steps"));
  EXPECT_THAT(refusal({PlaceStep{{"table"}}}), HasSubstr("an empty hand"));
  EXPECT_THAT(refusal({PickStep{"cam"}}), HasSubstr("Did you mean \"can\"?"));
  EXPECT_THAT(refusal({PickStep{"can"}, PlaceStep{{"tabel"}}}),
              HasSubstr("There are: pedestal, table, can"));
  EXPECT_THAT(refusal({PickStep{"can"}, PlaceStep{{"can"}}}), HasSubstr("the object itself"));
  EXPECT_THAT(refusal({PickStep{"can"}, PickStep{"can"}}), HasSubstr("a hand that carries can"));
  EXPECT_THAT(refusal({LineStep{{0.0, 0.0, 0.1}, "tabel"}}), HasSubstr("an object or a frame"));
  PoseStep unknown;
  unknown.goal.link = "plam";
  EXPECT_THAT(refusal({unknown}), HasSubstr("the link \"plam\""));
  EXPECT_THAT(refusal({PickStep{"can"}, FirstOfStep{{1, 1}, "either"}, PlaceStep{{"table"}},
                       LineStep{{0.0, 0.0, 0.1}}}),
              HasSubstr("an empty hand after one, can in the hand after another"));
}

TEST(Tasks, EndSoonWhenTheyAreStopped) {
  std::stop_source stop;
  stop.request_stop();
  const TaskPlan plan =
      planning::plan(shipped("can_on_table"), {PickStep{"can"}}, {}, stop.get_token());
  EXPECT_FALSE(plan.solved);
  EXPECT_EQ(plan.reason, "The search was interrupted.");
}

}  // namespace
}  // namespace handway::planning
