#include "handway/planning/tasks/task.h"

#include "handway/geometric/setup/placing.h"
#include "handway/planning/core/carried_objects.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/paths/path_check.h"
#include "handway_test/input_errors.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace handway::planning {
namespace {

using ::testing::HasSubstr;
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
  const Task task{PickStep{"can"}, PlaceStep{"table"}, MoveStep{*scene.scene->start, "start"}};
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

TEST(Tasks, PlaceAtAPose) {
  const SceneState scene = shipped("can_on_table");
  PlaceStep place;
  place.pose = geometric::find_object(*scene.scene, "can")->X_PO;
  place.pose.pretranslate(Eigen::Vector3d(-0.05, 0.12, geometric::kRestingGap));
  const TaskPlan plan = planning::plan(scene, {PickStep{"can"}, place});
  ASSERT_TRUE(plan.solved) << plan.reason;
  expect_valid(plan, scene);
  EXPECT_TRUE(geometric::find_object(*plan.stages.back().state.scene, "can")
                  ->X_PO.isApprox(place.pose, 1e-4));
}

TEST(Tasks, TellTheStageThatFails) {
  const SceneState scene = shipped("can_on_table");
  PlaceStep far;
  far.pose.translation() = Eigen::Vector3d(5.0, 0.0, 1.0);
  const TaskPlan plan = planning::plan(scene, {PickStep{"can"}, far}, {.grasps = {.most = 2}});
  EXPECT_FALSE(plan.solved);
  EXPECT_THAT(plan.stages, ::testing::IsEmpty());
  EXPECT_THAT(plan.reason, StartsWith("Step 2, place: in the stage \"lower\""));
  EXPECT_THAT(plan.reason, HasSubstr("The arm does not reach the place."));
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
  EXPECT_THAT(refusal({PlaceStep{"table"}}), HasSubstr("an empty hand"));
  EXPECT_THAT(refusal({PickStep{"cam"}}), HasSubstr("Did you mean \"can\"?"));
  EXPECT_THAT(refusal({PickStep{"can"}, PlaceStep{"tabel"}}),
              HasSubstr("There are: pedestal, table, can"));
  EXPECT_THAT(refusal({PickStep{"can"}, PlaceStep{"can"}}), HasSubstr("the object itself"));
  EXPECT_THAT(refusal({PickStep{"can"}, PickStep{"can"}}), HasSubstr("a hand that carries can"));
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
