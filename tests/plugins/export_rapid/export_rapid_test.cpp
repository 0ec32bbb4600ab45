#include "handway/geometric/math/units.h"
#include "handway_test/input_errors.h"
#include "handway_test/motions.h"
#include "rapid_exporter.h"
#include "rapid_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace handway::export_rapid {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

planning::Motion motion() {
  return test::with_robot_name(test::tx90_sah_motion(false, 0.5), "irb2400");
}

test::RapidModule module_of(const planning::Motion& motion,
                            const planning::ExportOptions& options = {}) {
  const auto files = RapidExporter().files(motion, options);
  const test::RapidModule read = test::read_rapid(files[0].content);
  EXPECT_EQ(files[0].name, read.name + ".mod");
  EXPECT_EQ(read.procedure, "run_" + read.name);
  return read;
}

TEST(RapidModule, KeepsTheGrammar) {
  const test::RapidModule read = module_of(motion());
  EXPECT_THAT(read.faults, IsEmpty());
  EXPECT_EQ(read.name, "wave");
  EXPECT_THAT(read.points, SizeIs(3)) << "the start and two moves";
  EXPECT_THAT(module_of(test::with_stages(motion()), {.gripper_output = 1}).faults, IsEmpty());
}

TEST(RapidReader, FindsWhatIsWrong) {
  const auto faults = [](const std::string& body) {
    return test::read_rapid("MODULE a\n" + body + "ENDMODULE\n").faults;
  };
  EXPECT_THAT(faults("PROC run()\n  WaitTime 1.0;\nENDPROC\n"), IsEmpty());
  EXPECT_THAT(faults("PROC run()\n  WaitTime 1.0\nENDPROC\n"), SizeIs(1)) << "no semicolon";
  EXPECT_THAT(faults("PROC run()\n  MoveAbsJ p1\\NoEOffs,v1000\\T:=1.0,fine,tool0;\nENDPROC\n"),
              ElementsAre(HasSubstr("unknown point")));
  EXPECT_THAT(faults("PROC run()\n"), SizeIs(2));
  EXPECT_THAT(faults("PROC a234567890123456789012345678901_3()\nENDPROC\n"), SizeIs(2));
}

TEST(RapidModule, GoesToTheWaypointsInTheirTimes) {
  const planning::Motion original = motion();
  const test::RapidModule read = module_of(original);
  ASSERT_THAT(read.moves, SizeIs(2));
  for (const std::size_t w : {1U, 3U}) {
    const test::RapidMove& move = read.moves[w / 2];
    for (std::size_t j = 0; j < move.angles.size(); ++j) {
      EXPECT_NEAR(move.angles[j], geometric::degrees(original.path.waypoints[w][original.arm[j]]),
                  1e-4);
    }
    const double duration = original.waypoint_times[w] - original.waypoint_times[w - 1];
    EXPECT_GE(move.duration, duration - 1e-9);
    EXPECT_NEAR(move.duration, duration, 1.1e-4);
  }
  for (std::size_t j = 0; j < 6; ++j) {
    EXPECT_NEAR(read.points.at("p0")[j],
                geometric::degrees(original.path.waypoints[0][original.arm[j]]), 1e-4);
  }
  const double pause = original.waypoint_times[2] - original.waypoint_times[1];
  EXPECT_GE(read.waited, pause - 1e-9);
  EXPECT_NEAR(read.waited, pause, 1.1e-3);
}

TEST(RapidModule, NamesStagesAndDrivesTheHand) {
  const planning::Motion staged = test::with_stages(motion());
  EXPECT_THAT(module_of(staged).comments,
              AllOf(Contains("stage: approach (pick can)"), Contains("attach: can"),
                    Contains("hand: closes, see wave_hand_targets.csv")));
  const test::RapidModule with = module_of(staged, {.gripper_output = 5, .gripper_time = 2.0});
  EXPECT_THAT(with.outputs, ElementsAre("do5 1"));
  EXPECT_NEAR(with.waited, 2.0, 2.1e-3);
}

TEST(RapidModule, SetsOutputsAndWaits) {
  const planning::Motion staged = test::with_outputs_and_wait(
      test::with_stages(motion()),
      {{"lamp_red", true}, {"3", false}, {"2", 1.5}, {"red lamp", true}, {"While", true}}, 2.5);
  const test::RapidModule read = module_of(staged);
  EXPECT_THAT(read.faults, IsEmpty());
  EXPECT_THAT(read.outputs, ElementsAre("lamp_red 1", "do3 0", "ao2 1.500000"));
  EXPECT_NEAR(read.waited - module_of(test::with_stages(motion())).waited, 2.5, 1e-9);
  EXPECT_THAT(read.comments, Contains("NOT SET: red lamp to true"));
  EXPECT_THAT(RapidExporter().warnings(staged),
              ElementsAre(HasSubstr("the output red lamp to true: RAPID sets signals by"),
                          HasSubstr("the output While to true")));
}

TEST(RapidModule, HasNamesOfAtMost32Characters) {
  planning::Motion named = motion();
  named.name = "a_task_with_a_name_that_is_much_too_long_for_rapid";
  const test::RapidModule read = module_of(named);
  EXPECT_THAT(read.faults, IsEmpty());
  EXPECT_EQ(read.procedure.size(), 32U);
  named.name = "Module";
  EXPECT_EQ(module_of(named).name, "hw_Module");
}

TEST(RapidExporter, ObjectsToArmsOfOtherMakers) {
  for (const char* robot : {"irb2400", "abb_irb120_3_58", "ABB", "CRB 15000", "IRB-1200"}) {
    EXPECT_THAT(RapidExporter().robot_objection(test::with_robot_name(motion(), robot)), IsEmpty())
        << robot;
  }
  for (const char* robot : {"rabbit", "tx90", "airbag300"}) {
    const planning::Motion other = test::with_robot_name(motion(), robot);
    EXPECT_THAT(test::refusal_of([&] { static_cast<void>(RapidExporter().files(other)); }),
                AllOf(HasSubstr("ABB"), HasSubstr("--any-robot")))
        << robot;
  }
}

TEST(RapidExporter, RefusesArmsOfSevenJoints) {
  const planning::Motion seven = test::with_robot_name(test::panda_motion(), "abb_yumi");
  EXPECT_THAT(test::refusal_of([&] { static_cast<void>(RapidExporter().files(seven)); }),
              HasSubstr("7 joints"));
}

TEST(RapidExporter, AsksForStopsAtWaypoints) { EXPECT_TRUE(RapidExporter().stops_at_waypoints()); }

}  // namespace
}  // namespace handway::export_rapid
