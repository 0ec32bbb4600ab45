#include "handway/planning/tasks/timed_task.h"

#include "handway/geometric/io/input_error.h"
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

/// A program that moves, sets an output, waits, and moves back.
Planned with_rests(const Task& rests) {
  const SceneState scene =
      load_scene(test::source_dir() / "scenes/can_on_table.yaml", PluginManager());
  Configuration aside = *scene.scene->start;
  aside[0] += 0.1;
  Planned made{{MoveStep{aside, "aside"}}, {}};
  made.task.insert(made.task.end(), rests.begin(), rests.end());
  made.task.emplace_back(MoveStep{*scene.scene->start, "start"});
  made.plan = plan_task(scene, made.task, *PlannerRegistry().create("auto"));
  return made;
}

TEST(TasksWithRests, StandStillForTheTime) {
  const Planned made = with_rests({OutputStep{"do3", true}, WaitStep{2.5}});
  ASSERT_TRUE(made.plan.solved) << made.plan.reason;
  const TimedTask timed = time_task(made.task, made.plan, "all");
  ASSERT_TRUE(timed.cleared());
  ASSERT_EQ(timed.motion.stages.size(), 4U);
  EXPECT_NO_THROW(check_motion(timed.motion));
  const MotionStage& output = timed.motion.stages[1];
  ASSERT_TRUE(output.output);
  EXPECT_EQ(output.output->name, "do3");
  EXPECT_EQ(output.step, "set do3 to true");
  const MotionStage& wait = timed.motion.stages[2];
  EXPECT_TRUE(wait.waits);
  EXPECT_EQ(wait.first, output.first) << "an output takes no time";
  const MotionStage& back = timed.motion.stages[3];
  EXPECT_EQ(back.first, wait.first + 1);
  EXPECT_NEAR(timed.motion.waypoint_times[back.first] - timed.motion.waypoint_times[wait.first],
              2.5, 1e-9);
  const auto rest = points_of_stage(timed.motion, 2);
  ASSERT_EQ(rest.size(), 2U);
  EXPECT_EQ(rest[0].position, rest[1].position);
  EXPECT_NEAR(rest[1].time - rest[0].time, 2.5, 1e-9);
  EXPECT_EQ(points_of_stage(timed.motion, 1).size(), 1U);
  EXPECT_EQ(stage_at(timed.motion, rest[0].time + 1.0)->name, "wait");
  EXPECT_EQ(stage_at(timed.motion, rest[1].time + 0.01)->name, "move");
  const TimedPath whole = whole_task(timed);
  EXPECT_NEAR(whole.preflight.duration, timed.motion.trajectory.duration(), 1e-9);
  int stops = 1;  // between both moves
  for (const TimedPath& stage : timed.stages) {
    stops += stage.blends.stops;
  }
  EXPECT_EQ(whole.blends.stops, stops);
}

TEST(TasksWithRests, RestForWholePeriods) {
  const Planned made = with_rests({WaitStep{0.001}});
  TimingOptions options;
  options.period = 0.02;
  const TimedTask timed = time_task(made.task, made.plan, "all", options);
  ASSERT_TRUE(timed.cleared());
  const auto& points = timed.motion.trajectory.points;
  for (std::size_t i = 1; i < points.size(); ++i) {
    ASSERT_NEAR(points[i].time - points[i - 1].time, 0.02, 1e-9);
  }
}

TEST(TasksWithRests, AreMotionsEvenIfNothingMoves) {
  const SceneState scene =
      load_scene(test::source_dir() / "scenes/can_on_table.yaml", PluginManager());
  const Task task{OutputStep{"do3", true}, OutputStep{"do4", 0.5}, OutputStep{"do3", true}};
  const TaskPlan plan = plan_task(scene, task, *PlannerRegistry().create("auto"));
  const TimedTask timed = time_task(task, plan, "all");
  ASSERT_TRUE(timed.cleared());
  EXPECT_NO_THROW(check_motion(timed.motion));
  EXPECT_EQ(timed.motion.path.waypoints.size(), 2U);
  EXPECT_EQ(outputs_of(timed.motion).size(), 2U) << "each once";
}

TEST(TrajectoriesWithRestsSampled, HaveAPointEveryPeriod) {
  Trajectory trajectory;
  for (const double time : {0.0, 0.01, 0.041, 0.051}) {
    trajectory.points.push_back({time, Configuration::Constant(1, time < 0.02 ? time : 0.01),
                                 Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1)});
  }
  const Trajectory sampled = with_rests_sampled(trajectory, 0.01);
  std::vector<double> times;
  for (const TrajectoryPoint& point : sampled.points) {
    times.push_back(point.time);
  }
  EXPECT_THAT(times, testing::ElementsAre(0.0, 0.01, testing::DoubleNear(0.02, 1e-12),
                                          testing::DoubleNear(0.03, 1e-12),
                                          testing::DoubleNear(0.04, 1e-12), 0.041, 0.051));
  EXPECT_EQ(sampled.points[3].position[0], 0.01);
  trajectory.points.back().time = 1e6;
  EXPECT_THROW(static_cast<void>(with_rests_sampled(trajectory, 0.01)), geometric::InputError);
}

TEST(Tasks, AreNotTimedWithoutAPlan) {
  const TimedTask timed = time_task(planned().task, {}, "all");
  EXPECT_FALSE(timed.cleared());
  EXPECT_TRUE(timed.motion.path.empty());
}

}  // namespace
}  // namespace handway::planning
