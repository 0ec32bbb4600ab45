/// `handway reproduce`: the paper's tables beside ours.
#include "command_line.h"
#include "handway_test/resource_use.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
                            HasSubstr("## Table 4"), HasSubstr("Preview: few runs"),
                            HasSubstr("### Problem 4: T in a kitchen shelf"),
                            HasSubstr("| Time to find a solution [s] | 71.64 | ")));
  EXPECT_THAT(report, AllOf(HasSubstr("| Processor |"), HasSubstr("| Handway | "),
                            Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
  EXPECT_THAT(line_.read("reproduce/report.html"), HasSubstr("<td>915.3</td>"));
  EXPECT_THAT(line_.read("reproduce/report.csv"),
              AllOf(HasSubstr("2,Reduced search space,\"pmd-prm: print, literal\",3,"),
                    HasSubstr("4,2: Can in a box,\"auto, our scene\",3,")));
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
  EXPECT_EQ(line_.run("reproduce --figure 15").exit_code, 2);
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
