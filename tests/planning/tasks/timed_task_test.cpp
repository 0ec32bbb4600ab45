#include "handway/planning/tasks/timed_task.h"

#include "handway/planning/extensions/exporter.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace handway::planning {
namespace {

struct Planned {
  Task task;
  TaskPlan plan;
};

const Planned& planned() {
  static const Planned kPlanned = [] {
    const SceneState scene =
        load_scene(test::source_dir() / "scenes/can_on_table.yaml", PluginManager());
    const PlannerRegistry planners;
    Planned made{{PickStep{"can"}, PlaceStep{{"table"}}, MoveStep{*scene.scene->start, "start"}},
                 {}};
    made.plan = plan_task(scene, made.task, *planners.create("auto"));
    return made;
  }();
  return kPlanned;
}

class TasksTimed : public testing::TestWithParam<bool> {
 protected:
  TimedTask timed() const {
    TimingOptions options;
    options.blends.deviation = GetParam() ? 0.05 : 0.0;
    return time_task(planned().task, planned().plan, "all", options);
  }
};

TEST_P(TasksTimed, AreOneMotionThatPassesItsStages) {
  const TimedTask timed = this->timed();
  ASSERT_TRUE(planned().plan.solved) << planned().plan.reason;
  ASSERT_TRUE(timed.cleared());
  EXPECT_NO_THROW(check_motion(timed.motion));
  EXPECT_EQ(timed.motion.name, "all");
  ASSERT_EQ(timed.motion.stages.size(), planned().plan.stages.size());
  double begin = 0.0;
  for (std::size_t i = 0; i < timed.stages.size(); ++i) {
    const MotionStage& mark = timed.motion.stages[i];
    const TaskStage& stage = planned().plan.stages[i];
    EXPECT_EQ(mark.name, to_string(stage.kind));
    EXPECT_EQ(mark.step, to_string(planned().task[stage.step]));
    EXPECT_NEAR(timed.motion.waypoint_times[mark.first], begin, 1e-9);
    EXPECT_EQ(timed.motion.path.waypoints[mark.first], stage.path.waypoints.front());
    EXPECT_EQ(stage_at(timed.motion, begin + 0.001)->name, mark.name);
    begin += timed.stages[i].motion.trajectory.duration();
    EXPECT_EQ(stage_at(timed.motion, begin)->name, mark.name) << "the border is of what ends there";
  }
  EXPECT_NEAR(timed.motion.trajectory.duration(), begin, 1e-9);
}

// The time axis has no gap: every point is one period after the one before.
TEST_P(TasksTimed, HaveOneTimeAxis) {
  const Trajectory trajectory = timed().motion.trajectory;
  for (std::size_t i = 1; i < trajectory.points.size(); ++i) {
    ASSERT_NEAR(trajectory.points[i].time - trajectory.points[i - 1].time, TimingOptions{}.period,
                1e-9);
  }
}

TEST_P(TasksTimed, RestAtTheBordersOfTheirStages) {
  const Motion motion = timed().motion;
  for (const MotionStage& stage : motion.stages) {
    const double time = motion.waypoint_times[stage.first];
    const auto point = static_cast<std::size_t>(std::lround(time / TimingOptions{}.period));
    EXPECT_NEAR(motion.trajectory.points[point].velocity.norm(), 0.0, 1e-9) << stage.name;
  }
}

TEST_P(TasksTimed, TellWhatTheHandDoes) {
  const Motion motion = timed().motion;
  std::vector<std::string> actions;
  for (const MotionStage& stage : motion.stages) {
    if (stage.hand != HandAction::kNone) {
      actions.push_back((stage.hand == HandAction::kClose ? "close " : "open ") + stage.object);
      EXPECT_EQ(stage.squeezed.size() > 0, stage.hand == HandAction::kClose);
    }
  }
  EXPECT_THAT(actions, testing::ElementsAre("close can", "open can"));
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutArcs, TasksTimed, testing::Bool());

TEST(Tasks, AreNotTimedWithoutAPlan) {
  const TimedTask timed = time_task(planned().task, {}, "all");
  EXPECT_FALSE(timed.cleared());
  EXPECT_TRUE(timed.motion.path.empty());
}

}  // namespace
}  // namespace handway::planning
