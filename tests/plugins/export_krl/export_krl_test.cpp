#include "handway/geometric/math/units.h"
#include "handway_test/input_errors.h"
#include "handway_test/motions.h"
#include "krl_exporter.h"
#include "krl_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace handway::export_krl {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

planning::Motion motion(double speed = 0.5) {
  return test::with_robot_name(test::tx90_sah_motion(false, speed), "kr10");
}

test::KrlProgram program(const planning::Motion& motion,
                         const planning::ExportOptions& options = {}) {
  const auto files = KrlExporter().files(motion, options);
  const test::KrlProgram read = test::read_krl(files[0].content, files[1].content);
  EXPECT_EQ(files[0].name, read.name + ".src");
  EXPECT_EQ(files[1].name, read.name + ".dat");
  return read;
}

TEST(KrlProgram, KeepsTheGrammar) {
  const test::KrlProgram read = program(motion());
  EXPECT_THAT(read.faults, IsEmpty());
  EXPECT_EQ(read.name, "wave");
  EXPECT_THAT(program(test::with_stages(motion()), {.gripper_output = 1}).faults, IsEmpty());
}

TEST(KrlReader, FindsWhatIsWrong) {
  const std::string data = "DEFDAT a\nDECL AXIS XP0={A1 0,A2 0,A3 0,A4 0,A5 0,A6 0}\nENDDAT\n";
  const auto faults = [&](const std::string& body) {
    return test::read_krl("DEF a()\n" + body + "END\n", data).faults;
  };
  EXPECT_THAT(faults("PTP XP0\nWAIT SEC 1.0\n"), IsEmpty());
  EXPECT_THAT(faults("PTP XP1\n"), ElementsAre(HasSubstr("unknown point")));
  EXPECT_THAT(faults("PTP XP0 C_PTP\n"), SizeIs(1)) << "it leaves the path";
  EXPECT_THAT(faults("HW_RATES(0,100)\n"), SizeIs(1));
  EXPECT_THAT(faults("IF TRUE THEN\n"), SizeIs(3));
  EXPECT_THAT(test::read_krl("DEF b()\nEND\n", data).faults, SizeIs(1));
}

// Duration of a joint's motion with a trapezium of speed, or a triangle of a short one, s.
double trapezium(double distance, double velocity, double acceleration) {
  return distance * acceleration < velocity * velocity
             ? 2.0 * std::sqrt(distance / acceleration)
             : distance / velocity + velocity / acceleration;
}

// The controller knows the files alone: the slowest axis of each move, and the waits.
void expect_no_shorter(const planning::Motion& motion) {
  const test::KrlProgram read = program(motion);
  ASSERT_THAT(read.moves, SizeIs(3)) << "to the start, and to two waypoints";
  std::vector<double> durations;
  for (std::size_t i = 1; i < read.moves.size(); ++i) {
    double slowest = 0.0;
    for (std::size_t j = 0; j < 6; ++j) {
      const int v = motion.arm[j];
      const double distance =
          geometric::radians(std::abs(read.moves[i].angles[j] - read.moves[i - 1].angles[j]));
      slowest = std::max(
          slowest, trapezium(distance, 0.01 * read.moves[i].velocity * motion.limits.velocity[v],
                             0.01 * read.moves[i].acceleration * motion.limits.acceleration[v]));
    }
    durations.push_back(slowest + read.moves[i].pause);
  }
  // The wait while the hand moves alone is behind the first move.
  const double first = motion.waypoint_times[2] - motion.waypoint_times[0];
  const double second = motion.waypoint_times[3] - motion.waypoint_times[2];
  EXPECT_GE(durations[0], first - 1e-5);
  EXPECT_GE(durations[1], second - 1e-5);
  // Whole per cents are coarse at low speeds.
  const double most = motion.speed < 0.1 ? 2.1 : 1.3;
  EXPECT_LT(durations[0], most * first);
  EXPECT_LT(durations[1], most * second);
}

TEST(KrlProgram, TakesByItsTextNoLessThanTheMotion) {
  for (const double speed : {1.0, 0.55, 0.5, 0.2, 0.05, 0.02}) {
    SCOPED_TRACE(speed);
    expect_no_shorter(motion(speed));
  }
}

TEST(KrlProgram, GoesToTheWaypoints) {
  const planning::Motion original = motion();
  const test::KrlProgram read = program(original);
  ASSERT_THAT(read.moves, SizeIs(3));
  const std::vector<std::size_t> waypoints = {0, 1, 3};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      EXPECT_NEAR(read.moves[i].angles[j],
                  geometric::degrees(original.path.waypoints[waypoints[i]][original.arm[j]]), 1e-4);
    }
  }
}

TEST(AxisRates, NeverExceedTheSpeed) {
  for (const double speed : {1.0, 0.55, 0.1}) {
    for (const planning::JointMove& move : joint_moves(motion(speed))) {
      if (!move.waits) {
        const AxisRates rates = axis_rates(move, speed);
        EXPECT_LE(rates.velocity, std::max(1.0, 100.0 * speed + 1e-6));
        EXPECT_LE(rates.acceleration, std::max(1.0, 100.0 * speed * speed + 1e-6));
      }
    }
  }
}

TEST(KrlProgram, NamesStagesAndDrivesTheHand) {
  const planning::Motion staged = test::with_stages(motion());
  EXPECT_THAT(program(staged).comments,
              AllOf(Contains("stage: approach (pick can)"), Contains("attach: can"),
                    Contains("hand: closes, see wave_hand_targets.csv")));
  const test::KrlProgram with = program(staged, {.gripper_output = 17, .gripper_time = 2.0});
  EXPECT_THAT(with.outputs, ElementsAre("17 TRUE"));
  EXPECT_GE(with.moves[1].pause, 2.0);
  EXPECT_THAT(test::refusal_of(
                  [&] { static_cast<void>(KrlExporter().files(staged, {.gripper_output = 0})); }),
              HasSubstr("1 to 4096"));
}

TEST(KrlProgram, SetsOutputsAndWaits) {
  const planning::Motion staged = test::with_outputs_and_wait(
      test::with_stages(motion()),
      {{"do4", true}, {"$OUT[4]", false}, {"ao2", 0.5}, {"lamp", true}, {"ao2", 3.0}}, 2.5);
  const test::KrlProgram read = program(staged);
  EXPECT_THAT(read.faults, IsEmpty());
  EXPECT_THAT(read.outputs, ElementsAre("4 TRUE", "4 FALSE", "analog 2 0.500000"));
  EXPECT_GE(read.moves.back().pause, 2.5);
  EXPECT_THAT(read.comments, Contains("NOT SET: lamp to true"));
  EXPECT_THAT(
      KrlExporter().warnings(staged),
      ElementsAre(HasSubstr("krl does not set the output lamp to true: KRL sets outputs by"),
                  HasSubstr("from -1 to 1")));
}

TEST(KrlProgram, HasNamesOfAtMost24Characters) {
  planning::Motion named = motion();
  named.name = "a_task_with_a_name_that_is_too_long_for_krl";
  EXPECT_THAT(program(named).faults, IsEmpty());
  EXPECT_EQ(program(named).name.size(), 24U);
  named.name = "Ptp";
  EXPECT_EQ(program(named).name, "hw_Ptp");
}

TEST(KrlExporter, ObjectsToArmsOfOtherMakers) {
  for (const char* robot : {"kr10", "kuka_kr6_support", "KR 210 R2700", "KUKA"}) {
    EXPECT_THAT(KrlExporter().robot_objection(test::with_robot_name(motion(), robot)), IsEmpty())
        << robot;
  }
  for (const char* robot : {"tx90", "ukr10", "kraken"}) {
    const planning::Motion other = test::with_robot_name(motion(), robot);
    EXPECT_THAT(test::refusal_of([&] { static_cast<void>(KrlExporter().files(other)); }),
                AllOf(HasSubstr("KUKA"), HasSubstr("--any-robot")))
        << robot;
  }
}

TEST(KrlExporter, SaysThatAnIiwaIsProgrammedInJava) {
  const planning::Motion seven = test::with_robot_name(test::panda_motion(), "kuka_iiwa14");
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(KrlExporter().files(seven)); }),
              AllOf(HasSubstr("7 joints"), HasSubstr("Java")));
}

TEST(KrlExporter, AsksForStopsAtWaypoints) { EXPECT_TRUE(KrlExporter().stops_at_waypoints()); }

}  // namespace
}  // namespace handway::export_krl
