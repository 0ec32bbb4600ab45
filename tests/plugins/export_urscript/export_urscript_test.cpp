#include "handway/geometric/math/units.h"
#include "handway_test/input_errors.h"
#include "handway_test/motions.h"
#include "urscript_exporter.h"
#include "urscript_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace handway::export_urscript {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kAngle = geometric::radians(1e-4);  // rad

planning::Motion motion(double speed = 0.5) {
  return test::with_robot_name(test::tx90_sah_motion(false, speed), "ur5e");
}

planning::Motion streamed_motion() {
  planning::TimingOptions options;
  options.period = UrScriptServoExporter().point_period();
  return test::with_robot_name(test::tx90_sah_motion(options), "ur5e");
}

test::UrProgram program(const planning::Motion& motion,
                        const planning::ExportOptions& options = {}) {
  const auto files = UrScriptExporter().files(motion, options);
  EXPECT_EQ(files[0].name, motion.name + ".script");
  return test::read_urscript(files[0].content);
}

test::UrProgram stream(const planning::Motion& motion,
                       const planning::ExportOptions& options = {}) {
  const auto files = UrScriptServoExporter().files(motion, options);
  EXPECT_EQ(files[0].name, motion.name + "_servo.script");
  return test::read_urscript(files[0].content);
}

void expect_at(const test::UrMove& move, const geometric::Configuration& q,
               const planning::Motion& motion) {
  for (std::size_t j = 0; j < move.q.size(); ++j) {
    ASSERT_NEAR(move.q[j], q[motion.arm[j]], kAngle);
  }
}

TEST(UrScript, KeepsTheGrammar) {
  const test::UrProgram read = program(motion());
  EXPECT_THAT(read.faults, IsEmpty());
  EXPECT_EQ(read.name, "wave");
  EXPECT_THAT(stream(streamed_motion()).faults, IsEmpty());
  EXPECT_THAT(program(test::with_stages(motion()), {.gripper_output = 1}).faults, IsEmpty());
}

TEST(UrScriptReader, FindsWhatIsWrong) {
  const auto faults = [](const char* text) { return test::read_urscript(text).faults; };
  EXPECT_THAT(faults("def a():\n  sleep(1.0)\nend\n"), IsEmpty());
  EXPECT_THAT(faults("def a():\n  sleep(1.0)\n"), ElementsAre(HasSubstr("not closed")));
  EXPECT_THAT(faults("def a():\n  movej([1, 2, 3], a=1, v=1, t=1)\nend\n"), SizeIs(1));
  EXPECT_THAT(faults("def a():\n  sleep(1e-3)\nend\n"), SizeIs(1));
  EXPECT_THAT(faults("def a():\n  set_standard_digital_out(8, True)\nend\n"), SizeIs(1));
  EXPECT_THAT(faults("sleep(1.0)\n"), ElementsAre(HasSubstr("outside")));
}

TEST(UrScript, GoesToTheWaypointsInTheirTimes) {
  const planning::Motion original = motion();
  const test::UrProgram read = program(original);
  ASSERT_THAT(read.moves, SizeIs(2)) << "and a wait between them";
  for (const std::size_t w : {1U, 3U}) {
    const test::UrMove& move = read.moves[w / 2];
    expect_at(move, original.path.waypoints[w], original);
    const double duration = original.waypoint_times[w] - original.waypoint_times[w - 1];
    EXPECT_GE(move.duration, duration - 1e-9);
    EXPECT_NEAR(move.duration, duration, 2e-6);
    // A trapezium of speed of the joint that moves the farthest takes the same time.
    const geometric::Configuration change =
        original.path.waypoints[w] - original.path.waypoints[w - 1];
    const double distance = change(original.arm).cwiseAbs().maxCoeff();
    EXPECT_NEAR(distance / move.velocity + move.velocity / move.acceleration, duration, 1e-4);
  }
  EXPECT_NEAR(read.slept, original.waypoint_times[2] - original.waypoint_times[1], 2e-6);
}

TEST(UrScript, NamesStagesAndDrivesTheHand) {
  const planning::Motion staged = test::with_stages(motion());
  const test::UrProgram without = program(staged);
  EXPECT_THAT(without.comments,
              AllOf(Contains("stage: approach (pick can)"), Contains("stage: close (pick can)"),
                    Contains("attach: can"), Contains("hand: closes, see wave_hand_targets.csv")));
  EXPECT_THAT(without.outputs, IsEmpty());
  EXPECT_THAT(UrScriptExporter().files(staged), SizeIs(2));
  const test::UrProgram with = program(staged, {.gripper_output = 5, .gripper_time = 2.0});
  EXPECT_THAT(with.outputs, ElementsAre("5 True"));
  EXPECT_NEAR(with.slept, 2.0, 1e-5);
  EXPECT_THAT(UrScriptExporter().files(staged, {.gripper_output = 5}), SizeIs(1));
}

TEST(UrScript, SetsOutputsAndWaits) {
  const planning::Motion staged = test::with_outputs_and_wait(test::with_stages(motion()),
                                                              {{"do7", true},
                                                               {"tool 1", false},
                                                               {"Config_out 3", true},
                                                               {"ao1", 0.25},
                                                               {"lamp", true},
                                                               {"do8", true},
                                                               {"ao0", 1.5}},
                                                              2.5);
  const test::UrProgram read = program(staged);
  EXPECT_THAT(read.faults, IsEmpty());
  EXPECT_THAT(read.outputs,
              ElementsAre("7 True", "tool 1 False", "configurable 3 True", "analog 1 0.250000"));
  EXPECT_NEAR(read.slept - program(test::with_stages(motion())).slept, 2.5, 1e-5);
  EXPECT_THAT(read.comments, Contains("NOT SET: lamp to true"));
  EXPECT_THAT(UrScriptExporter().warnings(staged),
              ElementsAre(HasSubstr("urscript does not set the output lamp to true: URScript sets"),
                          HasSubstr("do8"), HasSubstr("from 0 to 1")));
}

TEST(UrScriptServo, SleepsInsteadOfPointsWhileItWaits) {
  const planning::Motion original = test::with_stages(streamed_motion());
  const planning::Motion staged = test::with_outputs_and_wait(original, {{"do0", true}}, 3600.0);
  const test::UrProgram read = stream(staged);
  EXPECT_THAT(read.faults, IsEmpty());
  EXPECT_NEAR(read.slept, 3600.0, 1e-5);
  EXPECT_EQ(read.moves.size(), original.trajectory.points.size() - 1) << "no point is lost";
  EXPECT_THAT(read.outputs, ElementsAre("0 True"));
}

TEST(UrScriptServo, StreamsEveryPointOfTheMotion) {
  const planning::Motion original = streamed_motion();
  const test::UrProgram read = stream(original);
  const auto& points = original.trajectory.points;
  ASSERT_EQ(read.moves.size(), points.size() - 1);
  double time = 0.0;
  for (std::size_t i = 0; i < read.moves.size(); ++i) {
    expect_at(read.moves[i], points[i + 1].position, original);
    time += read.moves[i].duration;
    ASSERT_NEAR(time, points[i + 1].time, 1e-9);
  }
}

TEST(UrScriptServo, StreamsAllPointsOfAllStagesInOrder) {
  planning::TimingOptions options;
  options.period = 0.008;
  options.blends.deviation = 0.0;
  const planning::Motion staged =
      test::with_stages(test::with_robot_name(test::tx90_sah_motion(options), "ur5e"));
  const test::UrProgram read = stream(staged, {.gripper_output = 0, .gripper_time = 3.0});
  ASSERT_EQ(read.moves.size(), staged.trajectory.points.size() - 1);
  expect_at(read.moves.back(), staged.path.waypoints.back(), staged);
  EXPECT_THAT(read.comments, Contains("stage: lift (pick can)"));
  EXPECT_THAT(read.outputs, ElementsAre("0 True"));
  EXPECT_NEAR(read.slept, 3.0 - (staged.waypoint_times[2] - staged.waypoint_times[1]), 1e-5);
}

TEST(UrScript, ObjectsToArmsOfOtherMakers) {
  for (const char* robot : {"ur5e", "UR10", "my_ur3_robot", "UR5e class arm", "Universal Robots"}) {
    EXPECT_THAT(UrScriptExporter().robot_objection(
                    test::with_robot_name(test::tx90_sah_motion(false), robot)),
                IsEmpty())
        << robot;
  }
  for (const char* robot : {"tx90", "your5", "ur", "ur500", "kuka"}) {
    const planning::Motion other = test::with_robot_name(test::tx90_sah_motion(false), robot);
    EXPECT_THAT(test::refusal_of([&] { static_cast<void>(UrScriptExporter().files(other)); }),
                AllOf(HasSubstr("Universal Robots"), HasSubstr("--any-robot")))
        << robot;
  }
}

TEST(UrScript, RefusesWhatTheControllerCanNotRun) {
  const auto refusal = [](const planning::Motion& bad,
                          const planning::ExportOptions& options = {}) {
    return test::refusal_of([&] { static_cast<void>(UrScriptExporter().files(bad, options)); });
  };
  EXPECT_THAT(refusal(test::with_robot_name(test::panda_motion(), "ur_7")), HasSubstr("7 joints"));
  EXPECT_THAT(refusal(motion(), {.gripper_output = 8}), HasSubstr("0 to 7"));
  EXPECT_THAT(test::refusal_of([] { static_cast<void>(UrScriptServoExporter().files(motion())); }),
              HasSubstr("--period-ms 8"));
}

TEST(UrScript, HasNoNameOfTheLanguage) {
  planning::Motion named = motion();
  for (const char* word : {"movej", "end", "Thread"}) {
    named.name = word;
    const auto files = UrScriptExporter().files(named);
    EXPECT_EQ(test::read_urscript(files[0].content).name, std::string("hw_") + word);
  }
}

TEST(UrScript, HasNoTextOfNamesInItsCode) {
  planning::Motion odd = test::with_robot_name(motion(), "ur5\nhalt \"ü\"");
  EXPECT_THAT(program(odd).faults, IsEmpty());
  EXPECT_THAT(program(odd).comments, Contains(HasSubstr("ur5?halt")));
}

TEST(UrScript, AsksForStopsAndForItsPeriod) {
  EXPECT_TRUE(UrScriptExporter().stops_at_waypoints());
  EXPECT_FALSE(UrScriptServoExporter().stops_at_waypoints());
  EXPECT_EQ(UrScriptServoExporter().point_period(), 0.008);
}

}  // namespace
}  // namespace handway::export_urscript
