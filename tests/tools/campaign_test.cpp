/// `handway bench CAMPAIGN.yaml`: runs, interruptions, reports and what it refuses.
#include "command_line.h"
#include "run_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

namespace handway::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

constexpr const char* kStudy = R"(campaign: 1
name: Small study
problems:
  - open.yaml
  - {name: a post, file: post.yaml}
planners:
  - {planner: pmd-prm, parameters: {n_a: [5, 10]}}
  - rrt-connect
seeds: 10
time_limit_s: 30
)";

class HandwayCampaign : public testing::Test {
 protected:
  HandwayCampaign() { line_.write("study.yaml", kStudy); }

  [[nodiscard]] std::vector<std::string> rows(const std::string& folder) const {
    return run_rows(line_.folder() / folder / "runs.sqlite");
  }

  // Runs commands in the folder.
  [[nodiscard]] Outcome shell(const std::string& commands) const {
    return line_.run("--version >version.txt; ( " + commands + " )");
  }

  CommandLine line_;
};

TEST_F(HandwayCampaign, WritesRunsAndReports) {
  const Outcome run = line_.run("bench study.yaml --jobs 2");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("60 of 60 runs done, 60 solved"));
  EXPECT_THAT(run.err, HasSubstr("Small study: 60 runs, 2 simultaneously"));
  EXPECT_THAT(rows("study"), SizeIs(60));
  EXPECT_THAT(line_.read("study/report.md"),
              AllOf(HasSubstr("# Small study"), HasSubstr("## a post"),
                    HasSubstr("| pmd-prm n_a=5 | 10 | 100.0 % (72.2 to 100.0) |"),
                    HasSubstr("pmd-prm n_a=5 : rrt-connect"), Not(HasSubstr("nan"))));
  EXPECT_THAT(line_.read("study/report.html"), AllOf(HasSubstr("<svg"), Not(HasSubstr("nan"))));
  EXPECT_THAT(line_.read("study/runs.csv"), HasSubstr("\na post,rrt-connect,10,true,solved,"));
  EXPECT_THAT(line_.read("study/summary.csv"), HasSubstr("\nopen,pmd-prm n_a=10,10,10,1,0.722"));
  EXPECT_THAT(line_.read("study/comparisons.csv"), HasSubstr("open,pmd-prm n_a=5,rrt-connect,"));
  EXPECT_THAT(line_.read("study/boxplot.csv"), HasSubstr("a post,pmd-prm n_a=10,path_nodes,"));
  EXPECT_THAT(line_.read("study/ompl/a_post.log"),
              AllOf(HasSubstr("Experiment a_post\n"), HasSubstr("\n3 planners\npmd-prm n_a=5\n"),
                    HasSubstr("\n10 runs\n1; 1; 6; ")));
}

TEST_F(HandwayCampaign, DrawsHeatMapsOfPairsOfParameters) {
  line_.write("pairs.yaml",
              "campaign: 1\nproblems: [open.yaml, post.yaml]\nseeds: 2\nplanners:\n"
              "  - {planner: pmd-prm, label: a, parameters: {n_a: [5, 10], k: [10, 3, 4]}}\n"
              "  - {planner: pmd-prm, label: b, parameters: {n_h: [2, 10]}}\n  - rrt-connect\n");
  const Outcome run = line_.run("bench pairs.yaml");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(line_.read("pairs/report.md"),
              AllOf(HasSubstr("median time by n_a and k"), Not(HasSubstr("n_h and"))));
  EXPECT_THAT(line_.read("pairs/report.html"), HasSubstr(">n_a</text>"));
  EXPECT_THAT(line_.read("pairs/report.md"), HasSubstr("](drawings/1.svg)"));
  EXPECT_THAT(line_.read("pairs/drawings/1.svg"),
              AllOf(testing::StartsWith("<svg xmlns"), HasSubstr("font-family=\"sans-serif\""),
                    HasSubstr(">n_a</text>"), HasSubstr(" ms</text>")));
  const std::string table = line_.read("pairs/heatmaps.csv");
  EXPECT_THAT(table, AllOf(HasSubstr("\nopen,pmd-prm,a n_a=5 k=3,n_a,5,k,3,2,2,"),
                           HasSubstr("\npost,pmd-prm,a n_a=10 k=10,n_a,10,k,10,2,2,")));
  EXPECT_EQ(std::ranges::count(table, '\n'), 1 + 2 * 6);
  EXPECT_LT(table.find("n_a,5,k,3"), table.find("n_a,5,k,10")) << "by size";
}

TEST_F(HandwayCampaign, GivesTheSameRunsForAnyNumberOfJobs) {
  ASSERT_EQ(line_.run("bench study.yaml --out one --jobs 1").exit_code, 0);
  ASSERT_EQ(line_.run("bench study.yaml --out three --jobs 3").exit_code, 0);
  EXPECT_EQ(rows("one"), rows("three"));
}

// Kills the program over and over, at moments that differ, and goes on each time.
TEST_F(HandwayCampaign, LosesAndDoublesNothingWhenKilled) {
  ASSERT_EQ(line_.run("bench study.yaml --out whole").exit_code, 0);
  const fs::path database = line_.folder() / "killed" / "runs.sqlite";
  std::size_t kept = 0;
  for (int round = 0; round < 4; ++round) {
    const pid_t child = fork();
    if (child == 0) {
      fs::current_path(line_.folder());
      if (freopen("killed.txt", "w", stderr) == nullptr) {
        _exit(1);
      }
      execl(HANDWAY_PROGRAM, "handway", "bench", "study.yaml", "--out", "killed", "--resume",
            nullptr);
      _exit(127);
    }
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < deadline && run_count(database) <= kept + 3 &&
           waitpid(child, nullptr, WNOHANG) == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(3 + round));
    }
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    EXPECT_GE(run_count(database), kept) << "runs that were there are gone";
    kept = run_count(database);
  }
  const Outcome rest = line_.run("bench study.yaml --out killed --resume");
  ASSERT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_THAT(rest.err, HasSubstr("of them already done"));
  EXPECT_EQ(rows("killed"), rows("whole"));
}

TEST_F(HandwayCampaign, EndsOnInterruptAndSaysHowToGoOn) {
  line_.replace("study.yaml", "seeds: 10", "seeds: 2000");
  const Outcome run =
      shell("'" HANDWAY_PROGRAM
            "' bench study.yaml & child=$!; "
            "for i in $(seq 300); do [ -s study/runs.sqlite-wal ] && break; sleep 0.05; done; "
            "sleep 0.3; kill -INT $child; wait $child");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("continue with --resume"));
  EXPECT_THAT(line_.read("study/report.md"), HasSubstr("Incomplete: "));
}

TEST_F(HandwayCampaign, KeepsRunsOfOtherCampaignsInItsFolder) {
  ASSERT_EQ(line_.run("bench study.yaml").exit_code, 0);
  const Outcome again = line_.run("bench study.yaml");
  EXPECT_EQ(again.exit_code, 3);
  EXPECT_THAT(again.err, AllOf(HasSubstr("found 60 runs"), HasSubstr("--resume")));
  line_.replace("study.yaml", "seeds: 10", "seeds: 11");
  const Outcome more = line_.run("bench study.yaml --resume");
  EXPECT_EQ(more.exit_code, 0) << more.err;
  EXPECT_THAT(more.err, HasSubstr("66 runs, 60 of them already done"));
}

TEST_F(HandwayCampaign, DoesNotGoOnAfterAnEditOfAMeshTheRobotOrTheBasis) {
  line_.write("block.obj",
              "v 1.5 0 0\nv 1.6 0 0\nv 1.5 0.1 0\nv 1.5 0 0.1\n"
              "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  line_.replace("open.yaml", "objects:\n",
                "objects:\n  - {name: block, mesh: {file: block.obj}}\n");
  line_.write("one.yaml", "campaign: 1\nproblems: [open.yaml]\nseeds: 1\nplanners: [pmd-prm]\n");
  ASSERT_EQ(line_.run("bench one.yaml").exit_code, 0);
  ASSERT_EQ(line_.run("bench one.yaml --resume").exit_code, 0);
  const auto expect_refusal = [&](const std::string& file) {
    const std::string before = line_.read(file);
    line_.write(file, before + "\n");
    const Outcome again = line_.run("bench one.yaml --resume");
    EXPECT_EQ(again.exit_code, 3) << file;
    EXPECT_THAT(again.err, HasSubstr(file));
    line_.write(file, before);
  };
  expect_refusal("block.obj");
  expect_refusal("basis.yaml");
  expect_refusal("open_planar.urdf");
  EXPECT_EQ(line_.run("bench one.yaml --resume").exit_code, 0);
}

TEST_F(HandwayCampaign, TellsOfRunsWithoutAPath) {
  line_.write("walled_study.yaml",
              "campaign: 1\nproblems: [walled.yaml]\nseeds: 3\n"
              "planners: [{planner: pmd-prm, parameters: {max_samples: 50}}]\n");
  ASSERT_EQ(line_.run("bench walled_study.yaml").exit_code, 0);
  EXPECT_THAT(line_.read("walled_study/report.md"),
              AllOf(HasSubstr("0.0 % (0.0 to 56.1) | ∞"), HasSubstr("samples spent | 3"),
                    Not(HasSubstr("nan"))));
}

TEST_F(HandwayCampaign, RefusesBadFilesAndOptions) {
  line_.write("bad.yaml", "campaign: 1\nproblems: [open.yaml]\nplanners: [pmd-prn]\nseeds: 1\n");
  const Outcome bad = line_.run("bench bad.yaml");
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_THAT(bad.err, AllOf(HasSubstr("bad.yaml:3"), HasSubstr("planners[0]"),
                             HasSubstr("Did you mean \"pmd-prm\"?")));
  EXPECT_FALSE(fs::exists(line_.folder() / "bad"));
  for (const char* arguments :
       {"bench study.yaml --seeds 3", "bench study.yaml open.yaml", "bench study.yaml --checks",
        "bench open.yaml --resume", "bench open.yaml --jobs 2", "bench study.yaml --jobs 0"}) {
    EXPECT_EQ(line_.run(arguments).exit_code, 2) << arguments;
  }
}

TEST_F(HandwayCampaign, SaysWhenTheFolderCannotBeWritten) {
  line_.write("file", "in the way");
  const Outcome file = line_.run("bench study.yaml --out file/study");
  EXPECT_EQ(file.exit_code, 1);
  EXPECT_THAT(file.err, AllOf(HasSubstr("file/study"), HasSubstr("--out")));
  const Outcome device = line_.run("bench study.yaml --out /proc/self");
  EXPECT_EQ(device.exit_code, 1);
  EXPECT_THAT(device.err, HasSubstr("/proc/self"));
}

// A limit on the size of files stands for a disk that fills up while the campaign runs.
TEST_F(HandwayCampaign, SaysWhenTheDiskIsFullAndGoesOnLater) {
  line_.replace("study.yaml", "seeds: 10", "seeds: 60");
  const Outcome full =
      shell("trap '' XFSZ; ulimit -f 400; '" HANDWAY_PROGRAM "' bench study.yaml --jobs 2");
  EXPECT_EQ(full.exit_code, 1) << full.err;
  EXPECT_THAT(full.err, AllOf(HasSubstr("runs.sqlite"), HasSubstr("--resume")));
  const std::size_t kept = run_count(line_.folder() / "study" / "runs.sqlite");
  const Outcome rest = line_.run("bench study.yaml --resume");
  EXPECT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_GT(kept, 0U);
  EXPECT_THAT(rest.err, HasSubstr(std::to_string(kept) + " of them already done"));
  EXPECT_THAT(rows("study"), SizeIs(360));
}

}  // namespace
}  // namespace handway::test
