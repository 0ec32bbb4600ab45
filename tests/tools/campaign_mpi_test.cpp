/// `mpirun -n N handway bench CAMPAIGN.yaml`: the same runs as without it.
#include "command_line.h"
#include "handway_test/resource_use.h"
#include "run_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <string>

namespace handway::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

class HandwayUnderMpi : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(HANDWAY_PROCESS_TEAM).empty() ||
        std::system("command -v mpirun >/dev/null") != 0) {
      GTEST_SKIP() << "no MPI here";
    }
    test::ignore_leaks_of_children();
    line_.write("study.yaml",
                "campaign: 1\nproblems: [open.yaml, post.yaml]\nseeds: 8\n"
                "planners: [pmd-prm, rrt-connect]\n");
  }

  // Several processes on whatever cores there are.
  [[nodiscard]] Outcome mpirun(int processes, const std::string& arguments) const {
    return line_.run(
        "--version >version.txt; timeout 200 mpirun --allow-run-as-root "
        "--oversubscribe -n " +
        std::to_string(processes) + " '" HANDWAY_PROGRAM "' " + arguments);
  }
  [[nodiscard]] std::vector<std::string> rows(const std::string& folder) const {
    return run_rows(line_.folder() / folder / "runs.sqlite");
  }

  CommandLine line_;
};

TEST_F(HandwayUnderMpi, GivesTheSameRunsOnAnyNumberOfProcesses) {
  ASSERT_EQ(line_.run("bench study.yaml --out threads").exit_code, 0);
  ASSERT_THAT(rows("threads"), SizeIs(32));
  for (const int processes : {1, 2, 3}) {
    const std::string folder = "mpi" + std::to_string(processes);
    const Outcome run = mpirun(processes, "bench study.yaml --out " + folder);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_THAT(run.err,
                HasSubstr("study: 32 runs, " + std::to_string(processes) + " simultaneously"));
    EXPECT_THAT(run.out, HasSubstr("32 of 32 runs done"));
    EXPECT_EQ(rows(folder), rows("threads"));
    EXPECT_FALSE(line_.read(folder + "/report.md").empty());
  }
}

TEST_F(HandwayUnderMpi, GoesOnWithWhatThreadsBegan) {
  ASSERT_EQ(line_.run("bench study.yaml").exit_code, 0);
  line_.replace("study.yaml", "seeds: 8", "seeds: 10");
  const Outcome run = mpirun(2, "bench study.yaml --resume");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("40 runs, 32 of them already done"));
  EXPECT_THAT(rows("study"), SizeIs(40));
}

// Kills one of three processes without warning: the one that leads, and alone writes the database,
// or another one. mpirun then ends them all.
class HandwayUnderMpiWithout : public HandwayUnderMpi, public testing::WithParamInterface<int> {};

TEST_P(HandwayUnderMpiWithout, LosesAndDoublesNothing) {
  line_.replace("study.yaml", "seeds: 8", "seeds: 40");
  ASSERT_EQ(line_.run("bench study.yaml --out whole").exit_code, 0);
  ASSERT_THAT(rows("whole"), SizeIs(160));
  const fs::path database = line_.folder() / "killed" / "runs.sqlite";
  std::size_t kept = 0;
  for (int round = 0; round < 3; ++round) {
    fs::remove(line_.folder() / "victim");
    std::future<Outcome> team = std::async(std::launch::async, [&] {
      return line_.run(
          "--version >version.txt; timeout 200 mpirun --allow-run-as-root --oversubscribe -n 3 "
          "sh -c 'if [ \"$OMPI_COMM_WORLD_RANK\" = " +
          std::to_string(GetParam()) +
          " ]; then echo $$ >victim; fi; "
          "exec \"" HANDWAY_PROGRAM "\" bench study.yaml --out killed --resume'");
    });
    while (run_count(database) <= kept + 2 &&
           team.wait_for(std::chrono::milliseconds(3)) != std::future_status::ready) {
    }
    if (const pid_t victim = std::atoi(line_.read("victim").c_str()); victim > 0) {
      kill(victim, SIGKILL);
    }
    const Outcome ended = team.get();
    EXPECT_GE(run_count(database), kept) << "runs that were there are gone";
    kept = run_count(database);
    EXPECT_TRUE(kept == 160 || ended.exit_code != 0) << "an incomplete campaign looks complete";
  }
  ASSERT_GT(kept, 0U);
  const Outcome rest = mpirun(2, "bench study.yaml --out killed --resume");
  ASSERT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_THAT(rest.err, HasSubstr("of them already done"));
  EXPECT_EQ(rows("killed"), rows("whole"));
}

INSTANTIATE_TEST_SUITE_P(ItsLeaderOrAnother, HandwayUnderMpiWithout, testing::Values(0, 1),
                         [](const auto& test) { return "Rank" + std::to_string(test.param); });

TEST_F(HandwayUnderMpi, TellsOnceWhatIsWrong) {
  line_.write("bad.yaml", "campaign: 1\nproblems: [open.yaml]\nplanners: [pmd-prn]\nseeds: 1\n");
  const Outcome bad = mpirun(3, "bench bad.yaml");
  EXPECT_NE(bad.exit_code, 0);
  EXPECT_THAT(bad.err, HasSubstr("bad.yaml:3"));
  EXPECT_EQ(bad.err.find("bad.yaml:3"), bad.err.rfind("bad.yaml:3"));
}

TEST_F(HandwayUnderMpi, EndsWhenTheDatabaseCannotBeWritten) {
  line_.write("file", "in the way");
  const Outcome run = mpirun(2, "bench study.yaml --out file/study");
  EXPECT_NE(run.exit_code, 0);
  EXPECT_THAT(run.err, AllOf(HasSubstr("file/study"), Not(HasSubstr("MPI_ABORT"))));
}

}  // namespace
}  // namespace handway::test
