/// `handway grasp`: what it prints and writes, and its exit codes.
#include "command_line.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <string>

namespace handway::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class GraspCommand : public testing::Test {
 protected:
  static std::string scene() { return (source_dir() / "scenes" / "can_on_table.yaml").string(); }

  CommandLine line_;
};

TEST_F(GraspCommand, WritesGraspsAndAReport) {
  const Outcome run = line_.run("grasp " + scene() +
                                " can --count 2 --test 0 --out grasps.yaml --report report.json");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, StartsWith("Friction 0.6, payload 0.1 kg"));
  EXPECT_THAT(run.out, HasSubstr("epsilon"));
  const auto report = nlohmann::json::parse(line_.read("report.json"));
  EXPECT_EQ(report["object"], "can");
  EXPECT_EQ(report["friction"], 0.6);
  ASSERT_EQ(report["grasps"].size(), 2U);
  double last = 1.0;
  for (const auto& grasp : report["grasps"]) {
    EXPECT_GT(grasp["epsilon"], 0.0);
    EXPECT_EQ(grasp["doubt"], "");
    EXPECT_LE(grasp["score"], last) << "the best first";
    last = grasp["score"];
    EXPECT_EQ(grasp["grasp"].size(), report["joints"].size());
    EXPECT_EQ(grasp["squeeze"].size(), report["joints"].size());
    EXPECT_GE(grasp["contacts"].size(), 2U);
    EXPECT_LE(grasp["contacts"][0]["distance_mm"], 1.0);
  }
  EXPECT_THAT(line_.read("grasps.yaml"),
              testing::AllOf(StartsWith("handway_grasps: 1\nobject: \"can\"\npalm: "),
                             HasSubstr("    squeeze: {\""), HasSubstr("      - {finger: ")));
}

TEST_F(GraspCommand, SimulatesTheBestGrasps) {
  const Outcome run =
      line_.run("grasp " + scene() + " can --count 2 --test 1 --margins --report report.json");
  if (run.exit_code == 3) {
    EXPECT_THAT(run.err, HasSubstr("no plugin that simulates grasps"));
    GTEST_SKIP() << "built without MuJoCo";
  }
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("held"));
  EXPECT_THAT(run.out, HasSubstr("6/6"));
  const auto report = nlohmann::json::parse(line_.read("report.json"));
  EXPECT_FALSE(report["hold_assumptions"].empty());
  ASSERT_EQ(report["grasps"].size(), 2U);
  const auto& hold = report["grasps"][0]["hold"];
  EXPECT_TRUE(hold["held"]);
  EXPECT_EQ(hold["directions"].size(), 6U);
  EXPECT_TRUE(hold["lift"]["held"]);
  EXPECT_LT(hold["lift"]["slip_mm"], 5.0);
  EXPECT_LT(hold["least_friction"], 0.6);
  EXPECT_GT(hold["largest_mass"], 0.1);
  EXPECT_TRUE(hold.contains("position_error_mm"));
}

TEST_F(GraspCommand, ListsFirstWhatHoldsInTheSimulation) {
  const Outcome run =
      line_.run("grasp " + scene() + " can --count 8 --payload 0.6 --report report.json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto report = nlohmann::json::parse(line_.read("report.json"));
  if (report["hold_assumptions"].empty()) {
    GTEST_SKIP() << "built without MuJoCo";
  }
  ASSERT_EQ(report["grasps"].size(), 8U);
  const auto holds = [](const auto& grasp) {
    return grasp["hold"]["held"] && grasp["hold"]["lift"]["held"];
  };
  EXPECT_TRUE(holds(report["grasps"][0]));
  EXPECT_TRUE(std::ranges::is_partitioned(report["grasps"], holds));
}

TEST_F(GraspCommand, MeasuresGraspsOfAFile) {
  ASSERT_EQ(line_.run("grasp " + scene() + " can --count 2 --test 0 --out own.yaml").exit_code, 0);
  const Outcome run = line_.run("grasp " + scene() + " can --from own.yaml --test 0");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("own.yaml:"));
  line_.write("far.json", R"([{"pose": [9, 0, 0, 0, 0, 0, 1], "joints": {}}])");
  const Outcome far = line_.run("grasp " + scene() + " can --from far.json --test 0");
  EXPECT_EQ(far.exit_code, 1);
  EXPECT_THAT(far.err, HasSubstr("far.json:1: the arm does not get there."));
  EXPECT_THAT(far.out, HasSubstr("None of the 1 given is possible."));
  EXPECT_EQ(line_.run("grasp " + scene() + " can --from missing.yaml").exit_code, 3);
}

TEST_F(GraspCommand, NeedsNoGoalInTheScene) {
  std::filesystem::copy_file(scene(), line_.folder() / "scene.yaml");
  line_.replace("scene.yaml", "\ngoal: ", "\n# ");
  const Outcome run = line_.run("grasp scene.yaml can --count 1");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("epsilon"));
}

TEST_F(GraspCommand, SaysWhyThereIsNone) {
  const Outcome run = line_.run("grasp " + scene() + " table");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.out, StartsWith("No grasp of table found. table is too large"));
}

TEST_F(GraspCommand, PutsGraspsThatMaySlipInDoubt) {
  const Outcome run = line_.run("grasp " + scene() + " can --count 3 --friction 0.01");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.out, HasSubstr("With friction 0.01, the contacts do not hold it"));
}

TEST_F(GraspCommand, RefusesWhatIsNotThere) {
  EXPECT_EQ(line_.run("grasp " + scene() + " cup").exit_code, 3);
  EXPECT_EQ(line_.run("grasp " + scene()).exit_code, 2);
  EXPECT_EQ(line_.run("grasp " + scene() + " can --friction 0").exit_code, 2);
  EXPECT_EQ(line_.run("grasp missing.yaml can").exit_code, 3);
}

}  // namespace
}  // namespace handway::test
