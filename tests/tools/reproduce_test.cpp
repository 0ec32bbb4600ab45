/// `handway reproduce`: the paper's tables beside ours.
#include "command_line.h"
#include "handway_test/resource_use.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace handway::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class HandwayReproduce : public testing::Test {
 protected:
  // Uses only the scenes that ship: the published problems take longer.
  HandwayReproduce() {
    unsetenv("HANDWAY_REFERENCE_DIR");
    test::ignore_leaks_of_children();
  }

  CommandLine line_;
};

TEST_F(HandwayReproduce, WritesAllTablesQuicklyInAFreshFolder) {
  const Outcome run = line_.run("reproduce --quick");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("reproduce/report.html"));
  const std::string report = line_.read("reproduce/report.md");
  EXPECT_THAT(report, AllOf(HasSubstr("## Table 2"), HasSubstr("## Table 3"),
                            HasSubstr("## Table 4"), HasSubstr("Preview, made in "),
                            HasSubstr("### Problem 4: T on a cluttered table"),
                            HasSubstr("| Time to find a solution [s] | 71.64 | ")));
  EXPECT_THAT(report, AllOf(HasSubstr("| Processor |"), HasSubstr("| Handway | "),
                            Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
  EXPECT_THAT(line_.read("reproduce/report.html"), HasSubstr("<td>915.3</td>"));
  EXPECT_THAT(line_.read("reproduce/report.csv"),
              AllOf(HasSubstr("2,Reduced search space,\"pmd-prm: print, literal\",3,"),
                    HasSubstr("4,2: Can in a box,\"Default planner, our scene\",3,")));
  // The first paragraph says what the runs reproduce, and Table 4 where their time goes.
  const std::string beginning = report.substr(0, report.find("Preview"));
  EXPECT_THAT(beginning,
              AllOf(HasSubstr("Reduced search space: reproduced: "),
                    HasSubstr("Full divided by reduced: reproduced: "),
                    HasSubstr("print read literally: "), HasSubstr("of 3 runs find a path"),
                    HasSubstr("Problem 1: Cans on a desk: reproduced: ")));
  EXPECT_THAT(report, AllOf(HasSubstr("| Connecting [% of the time] | - | "),
                            HasSubstr("Where the time goes")));
  for (const char* part : {"paper_table_2", "paper_table_4"}) {
    EXPECT_TRUE(std::filesystem::exists(line_.folder() / "reproduce" / part / "runs.sqlite"));
  }
}

TEST_F(HandwayReproduce, GoesOnWithMoreRuns) {
  ASSERT_EQ(line_.run("reproduce --table 2 --quick --runs 1 --out tables").exit_code, 0);
  EXPECT_EQ(line_.run("reproduce --table 2 --quick --runs 2 --out tables").exit_code, 3);
  const Outcome more = line_.run("reproduce --table 2 --quick --runs 2 --out tables --resume");
  EXPECT_EQ(more.exit_code, 0) << more.err;
  EXPECT_THAT(more.err, HasSubstr("14 runs, 7 of them already done"));
}

TEST_F(HandwayReproduce, ListsTheParametersWithoutAnyRun) {
  const Outcome run = line_.run("reproduce --table 3 --out parameters");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(
      line_.read("parameters/report.md"),
      AllOf(HasSubstr("| n_H, hand trials | 10 | 10 | 20 | 20 |"), Not(HasSubstr("Incomplete"))));
  EXPECT_EQ(line_.run("reproduce --table 5").exit_code, 2);
}

// The data of a figure are written even if it can't be drawn.
TEST_F(HandwayReproduce, MakesFilmStripsOfPaths) {
  const Outcome run = line_.run("reproduce --figure 14 --quick --out films");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string report = line_.read("films/report.md");
  EXPECT_THAT(report,
              AllOf(HasSubstr("## Fig. 14"), Not(HasSubstr("Table")), Not(HasSubstr("Fig. 17"))));
  EXPECT_THAT(line_.read("films/figure_14.yaml"),
              HasSubstr("path: figure_14/two_cans_on_table_pmd-prm"));
  EXPECT_THAT(line_.read("films/figure_14/two_cans_on_table_full-prm.csv"), HasSubstr("time,"));
  if (std::filesystem::exists(std::filesystem::path(HANDWAY_PROGRAM).parent_path() /
                              "handway-figures")) {
    EXPECT_THAT(line_.read("films/figure_14.png"), testing::StartsWith("\x89PNG")) << report;
    EXPECT_THAT(report, HasSubstr("](figure_14.png)"));
    EXPECT_THAT(line_.read("films/report.html"),
                HasSubstr("<img src=\"data:image/png;base64,iVBO"));
  } else {
    EXPECT_THAT(report, HasSubstr("handway-figures"));
  }
  EXPECT_THAT(report, HasSubstr("preset=print, growth=linear, seed 1"));
  EXPECT_THAT(line_.read("films/figure_14.csv"),
              AllOf(HasSubstr("Principal motion directions (pmd-prm),"),
                    HasSubstr("mean distance of the hand from SC_h")));
  EXPECT_EQ(line_.run("reproduce --figure 18").exit_code, 2);
}

TEST_F(HandwayReproduce, MeasuresFiguresOfSamplingAndOfTheSearchRange) {
  const Outcome run =
      line_.run("reproduce --figure 11 --figure 12 --figure 13 --quick --out planner");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string report = line_.read("planner/report.md");
  EXPECT_THAT(report, AllOf(HasSubstr("## Fig. 11"), HasSubstr("## Fig. 12"),
                            HasSubstr("## Fig. 13"), Not(HasSubstr("Incomplete"))));
  // Two joints have two directions, which have all of the variance.
  EXPECT_THAT(line_.read("planner/figure_11.csv"), HasSubstr("\nê1,"));
  // Hypercubes come in the order of van der Corput.
  EXPECT_THAT(line_.read("planner/figure_12.csv"),
              testing::ContainsRegex("\n0.000,8,[0-9]+\n1.000,8,[0-9]+\n0.500,8,[0-9]+\n0.250,8,"));
  EXPECT_THAT(line_.read("planner/figure_13.csv"),
              testing::ContainsRegex("\ns1,0.0,.*\ns2,1.0,.*\ns3,0.5,start,0.5,1.0\n"));
  for (const char* figure : {"figure_11.svg", "figure_12.svg", "figure_13.svg"}) {
    EXPECT_THAT(line_.read(std::string("planner/") + figure), testing::StartsWith("<svg xmlns"));
  }
}

TEST_F(HandwayReproduce, RunsAPathOnEmulatedDevicesBesideItsSimulation) {
  const Outcome run = line_.run("reproduce --figure 15 --quick --out side_by_side");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string report = line_.read("side_by_side/report.md");
  EXPECT_THAT(report, AllOf(HasSubstr("## Fig. 15"), HasSubstr("no real robot was there")));
  EXPECT_THAT(line_.read("side_by_side/figure_15.csv"), HasSubstr("\n0.00,"));
  const std::string planned = line_.read("side_by_side/figure_15/planned.csv");
  const std::string measured = line_.read("side_by_side/figure_15/measured.csv");
  EXPECT_EQ(std::ranges::count(planned, '\n'), 7) << "a header and six points";
  EXPECT_EQ(std::ranges::count(measured, '\n'), 7);
  EXPECT_NE(planned, measured);
}

TEST_F(HandwayReproduce, MeasuresHowHardTheProblemsAre) {
  const Outcome run = line_.run("reproduce --figure 16 --quick --out problems");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string table = line_.read("problems/figure_16.csv");
  EXPECT_EQ(std::ranges::count(table, '\n'), 6) << "a header, Table 2's task and four problems";
  EXPECT_THAT(table,
              AllOf(HasSubstr("straight motion in collision"), HasSubstr("\n1: Cans on a desk,")));
  EXPECT_THAT(line_.read("problems/figure_16.yaml"), HasSubstr("frames: waypoints"));
}

TEST_F(HandwayReproduce, MakesFiguresOfHandPosturesBesideThePublishedNumbers) {
  const Outcome run = line_.run("reproduce --figure 7 --figure 10 --quick --out postures");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string report = line_.read("postures/report.md");
  EXPECT_THAT(report, AllOf(HasSubstr("## Fig. 7"), HasSubstr("## Fig. 10"),
                            Not(HasSubstr("Fig. 8")), Not(HasSubstr("Table 2"))));
  EXPECT_THAT(report,
              HasSubstr("| Directions | published [%] | free_hand, joints by limits [%] |"));
  EXPECT_THAT(report, AllOf(HasSubstr("| 1 | 42.19 | 43.79 |"), HasSubstr("| 4 | - | 88.42 |"),
                            HasSubstr("| index abduction, ring abduction | 4, 10 | negative | -")));
  EXPECT_THAT(report, Not(HasSubstr("Simultaneous runs")));
  EXPECT_THAT(line_.read("postures/figure_10.csv"), HasSubstr("\n2,77.12,79.56,"));
  EXPECT_THAT(line_.read("postures/figure_7.csv"), HasSubstr("\"middle proximal, ring proximal\""));
  EXPECT_THAT(report, HasSubstr("](postures/free_hand/correlations.svg)"));
  for (const char* plot : {"correlations", "variance"}) {
    EXPECT_THAT(line_.read(std::string("postures/postures/free_hand/") + plot + ".svg"),
                testing::StartsWith("<svg xmlns"));
  }
  EXPECT_THAT(line_.read("postures/report.html"),
              AllOf(HasSubstr("Joint 8, middle proximal [°]"), HasSubstr("Variance covered [%]")));
}

TEST(HandwayReproduceOnPublishedRecordings, AnalysesThemBesideTheOneThatShips) {
  HANDWAY_NEED_REFERENCE(reference);
  setenv("HANDWAY_REFERENCE_DIR", reference.c_str(), 1);
  CommandLine line;
  const Outcome run = line.run("reproduce --figure 10 --out people");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(line.read("people/figure_10.csv"),
              AllOf(HasSubstr("\"calib-rad-su01, joints by own range [%]\""),
                    HasSubstr("\n1,42.19,43.79,35.00,51.08,41.64,73.89,61.12\n")));
}

}  // namespace
}  // namespace handway::test
