/// `handway bench`: the tables, the files and what it refuses.
#include "command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace handway::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class HandwayBench : public testing::Test {
 protected:
  CommandLine line_;
};

TEST_F(HandwayBench, MeasuresChecksAndPlans) {
  const Outcome run =
      line_.run("bench open.yaml post.yaml --planner rrt-connect --seeds 2 --out results");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("open"), HasSubstr("post"), HasSubstr("auto"),
                             HasSubstr("rrt-connect"), HasSubstr("2/2"), Not(HasSubstr("FAULT"))));

  const auto report = nlohmann::json::parse(line_.read("results/bench.json"));
  EXPECT_EQ(report["seeds"], 2);
  ASSERT_EQ(report["scenes"].size(), 2U);
  const auto& post = report["scenes"][1];
  EXPECT_EQ(post["scene"], "post");
  EXPECT_GT(post["load_s"], 0.0);
  EXPECT_GT(post["load_memory_bytes"], 1000000);
  for (const char* checker : {"fast", "fcl"}) {
    EXPECT_GT(post["collision"][checker]["configuration_us"], 0.0) << checker;
    EXPECT_GT(post["collision"][checker]["edge_us"], 0.0) << checker;
  }
  EXPECT_GT(post["collision"]["fcl_broadphase"]["configuration_us"], 0.0);
  EXPECT_EQ(post["collision"]["disagreements"], 0);
  ASSERT_EQ(post["plans"].size(), 2U);
  EXPECT_EQ(post["plans"][0]["planner"], "auto");
  EXPECT_EQ(post["plans"][0]["ratio"], 1.0);
  const auto& plan = post["plans"][1];
  EXPECT_EQ(plan["planner"], "rrt-connect");
  EXPECT_EQ(plan["solved"], 2);
  ASSERT_EQ(plan["runs"].size(), 2U);
  const auto time_of = [&](std::size_t i) {
    const double planning = plan["runs"][i]["time_s"];
    const double smoothing = plan["runs"][i]["smoothing_s"];
    return planning + smoothing;
  };
  const double first = time_of(0);
  const double second = time_of(1);
  EXPECT_EQ(plan["median_s"], std::min(first, second));
  EXPECT_EQ(plan["p95_s"], std::max(first, second));
  EXPECT_GE(plan["path_nodes"], 2);
  EXPECT_EQ(plan["length"], std::min(plan["runs"][0]["objective"]["length"].get<double>(),
                                     plan["runs"][1]["objective"]["length"].get<double>()));
}

TEST_F(HandwayBench, WritesARowForEverySceneAndPlanner) {
  ASSERT_EQ(line_.run("bench open.yaml --planner all --seeds 1 --time-limit 5 --out .").exit_code,
            0);
  const std::vector<std::string> rows = lines_of(line_.read("bench.csv"));
  ASSERT_GE(rows.size(), 5U) << "the header and four planners at least";
  for (const std::string& row : rows) {
    EXPECT_EQ(std::ranges::count(row, ','), std::ranges::count(rows.front(), ',')) << row;
  }
  EXPECT_THAT(rows[0], testing::StartsWith("scene,load_s"));
  EXPECT_THAT(rows[1], AllOf(testing::StartsWith("open,"), HasSubstr(",auto,fast,1,5,1,1,,")));
}

TEST_F(HandwayBench, CountsARunWithoutAPathAsEndless) {
  const Outcome run = line_.run("bench walled.yaml --seeds 1 --time-limit 0.2 --out .");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("0/1"), HasSubstr("No path found")));
  const auto plan = nlohmann::json::parse(line_.read("bench.json"))["scenes"][0]["plans"][0];
  EXPECT_EQ(plan["solved"], 0);
  EXPECT_TRUE(plan["median_s"].is_null());
  EXPECT_TRUE(plan["path_nodes"].is_null());
}

TEST_F(HandwayBench, PlansTheSameWithFcl) {
  ASSERT_EQ(line_.run("bench post.yaml --seeds 1 --out fast").exit_code, 0);
  ASSERT_EQ(line_.run("bench post.yaml --seeds 1 --checker fcl --out fcl").exit_code, 0);
  const auto fast = nlohmann::json::parse(line_.read("fast/bench.json"));
  const auto fcl = nlohmann::json::parse(line_.read("fcl/bench.json"));
  EXPECT_EQ(fcl["scenes"][0]["plans"][0]["checker"], "fcl");
  // Smoothing has a budget of configurations, and bounds of FCL take others to settle an edge.
  for (const char* key : {"solved", "samples"}) {
    EXPECT_EQ(fcl["scenes"][0]["plans"][0][key], fast["scenes"][0]["plans"][0][key]) << key;
  }
}

TEST_F(HandwayBench, ComparesCheckersInOneTable) {
  const Outcome run = line_.run(
      "bench post.yaml --seeds 2 --checker fast --checker fcl-broadphase --check-paths --out .");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("fcl-broadphase"), HasSubstr("2 of 2 paths valid at 1 mm"),
                             Not(HasSubstr("FAULT"))));
  const auto plans = nlohmann::json::parse(line_.read("bench.json"))["scenes"][0]["plans"];
  ASSERT_EQ(plans.size(), 2U);
  EXPECT_EQ(plans[0]["checker"], "fast");
  EXPECT_EQ(plans[1]["checker"], "fcl-broadphase");
  for (const auto& plan : plans) {
    EXPECT_EQ(plan["paths_checked"], true);
    EXPECT_EQ(plan["paths_with_faults"], 0);
  }
}

TEST_F(HandwayBench, MeasuresChecksAlone) {
  const Outcome run = line_.run("bench post.yaml --checks --out .");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, Not(HasSubstr("pmd-prm")));
  const std::vector<std::string> rows = lines_of(line_.read("bench.csv"));
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(std::ranges::count(rows[1], ','), std::ranges::count(rows[0], ','));
}

TEST_F(HandwayBench, RefusesWhatItCanNotMeasure) {
  for (const std::string arguments :
       {"--seeds 0", "--threads 0", "--time-limit 0", "--checker ode", "--fast"}) {
    EXPECT_EQ(line_.run("bench open.yaml " + arguments).exit_code, 2) << arguments;
  }
  const Outcome planner = line_.run("bench open.yaml --planner prn");
  EXPECT_EQ(planner.exit_code, 3);
  EXPECT_THAT(planner.err, AllOf(HasSubstr("prn"), HasSubstr("pmd-prm")));
  const Outcome scene = line_.run("bench open.yaml none.yaml --checks");
  EXPECT_EQ(scene.exit_code, 3);
  EXPECT_THAT(scene.err, HasSubstr("none.yaml"));
  const Outcome folder = line_.run("bench open.yaml --checks --out open.yaml");
  EXPECT_EQ(folder.exit_code, 1);
  EXPECT_THAT(folder.err, HasSubstr("open.yaml"));
  line_.replace("post.yaml", "-0.4", "-0.066");
  EXPECT_EQ(line_.run("bench post.yaml --seeds 3").exit_code, 4) << "the start collides";
}

TEST_F(HandwayBench, SaysThatAPlannerNeedsABasis) {
  line_.replace("open.yaml", "hand_basis: basis.yaml", "planner: {name: rrt-connect}");
  const Outcome run = line_.run("bench open.yaml --planner pmd-prm --seeds 1");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("not run"), HasSubstr("PMD basis"), HasSubstr("1/1")));
}

}  // namespace
}  // namespace handway::test
