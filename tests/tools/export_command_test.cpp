/// `handway time` and `handway export`, on small problems and on the scenes that ship.
#include "command_line.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace handway::test {
namespace {

namespace fs = std::filesystem;

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

class Export : public testing::Test {
 protected:
  void SetUp() override {
    const Outcome plan = line_.run("plan post.yaml --seed 3 --out path.csv");
    ASSERT_EQ(plan.exit_code, 0) << plan.err;
  }

  CommandLine line_;
};

TEST_F(Export, WritesACsvThatChecksAsAPath) {
  const Outcome done = line_.run("export path.csv --scene post.yaml --to csv --out out");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("cleared"), HasSubstr("velocity"), HasSubstr("clearance"),
                              HasSubstr("out/path.csv")));
  EXPECT_THAT(line_.read("out/path.csv"), StartsWith("time,"));
  const Outcome check = line_.run("check post.yaml out/path.csv");
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
}

TEST_F(Export, SaysHowLongAPathTakes) {
  const Outcome fast = line_.run("time path.csv --scene post.yaml --report fast.json");
  EXPECT_EQ(fast.exit_code, 0) << fast.err;
  const Outcome stops = line_.run("time path.csv --scene post.yaml --no-blend --report stops.json");
  EXPECT_EQ(stops.exit_code, 0) << stops.err;
  const Outcome slow = line_.run("time path.csv --scene post.yaml --speed 0.5 --report slow.json");
  EXPECT_EQ(slow.exit_code, 0) << slow.err;
  const auto seconds = [&](const char* file) {
    const auto report = nlohmann::json::parse(line_.read(file));
    EXPECT_EQ(report["cleared"], true);
    return report["duration_s"].get<double>();
  };
  EXPECT_LE(seconds("fast.json"), seconds("stops.json"));
  EXPECT_NEAR(seconds("slow.json"), 2.0 * seconds("fast.json"), 0.02);
}

TEST_F(Export, NamesLimitsThatWereAssumed) {
  const auto velocities_and_accelerations =
      AllOf(HasSubstr("no velocity limits given"), HasSubstr("no acceleration limits given"),
            HasSubstr("shoulder, elbow, thumb, left, right"), Not(HasSubstr("jerk")));
  const Outcome time = line_.run("time path.csv --scene post.yaml --report report.json");
  EXPECT_THAT(time.out, velocities_and_accelerations);
  const auto report = nlohmann::json::parse(line_.read("report.json"));
  ASSERT_EQ(report["assumed_limits"].size(), 10U);
  EXPECT_EQ(report["assumed_limits"][0],
            (nlohmann::json{{"joint", "shoulder"}, {"limit", "velocity"}, {"value", 1.0}}));
  EXPECT_EQ(report["assumed_limits"][5],
            (nlohmann::json{{"joint", "shoulder"}, {"limit", "acceleration"}, {"value", 4.0}}));
  EXPECT_THAT(line_.run("export path.csv --scene post.yaml --to csv --out out").out,
              velocities_and_accelerations);
  EXPECT_THAT(line_.run("time path.csv --scene post.yaml --jerk").out,
              HasSubstr("no jerk limits given"));
}

TEST_F(Export, RefusesLimitsOfAJointThatTheRobotHasNot) {
  line_.write("limits.yaml", "joint_limits:\n  sholder:\n    max_velocity: 0.1\n");
  for (const char* command : {"time path.csv --scene post.yaml",
                              "export path.csv --scene post.yaml --to csv --out out"}) {
    const Outcome done = line_.run(std::string(command) + " --limits limits.yaml");
    EXPECT_EQ(done.exit_code, 3) << command;
    EXPECT_THAT(done.err, AllOf(HasSubstr("limits.yaml:"), HasSubstr("joint_limits.sholder"),
                                HasSubstr("The nearest are shoulder")));
  }
  EXPECT_FALSE(fs::exists(line_.folder() / "out"));
}

TEST_F(Export, KeepsLimitsOfAFile) {
  line_.write("limits.yaml", "joint_limits:\n  shoulder:\n    max_velocity: 0.1\n");
  const Outcome done =
      line_.run("time path.csv --scene post.yaml --limits limits.yaml --report report.json");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  const auto report = nlohmann::json::parse(line_.read("report.json"));
  EXPECT_EQ(report["velocity"]["joint"], "shoulder");
  EXPECT_GT(report["duration_s"], 8.0) << "0.8 rad";
}

TEST_F(Export, RefusesAPathThatCollides) {
  line_.write("through.csv", "shoulder,elbow,thumb,left,right\n-0.4,0,0,0,0\n0.4,0,0,0,0\n");
  const Outcome done =
      line_.run("export through.csv --scene post.yaml --to csv --out out --report report.json");
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_THAT(done.out, AllOf(HasSubstr("NOT CLEARED"), HasSubstr("post")));
  EXPECT_FALSE(fs::exists(line_.folder() / "out"));
  const auto report = nlohmann::json::parse(line_.read("report.json"));
  EXPECT_EQ(report["cleared"], false);
  EXPECT_THAT(report["faults"][0]["text"].get<std::string>(), HasSubstr("post"));
}

TEST_F(Export, RefusesAPathThatDoesNotBeginAtTheStart) {
  line_.write("away.csv", "shoulder,elbow,thumb,left,right\n-0.9,0,0,0,0\n-0.4,0,0,0,0\n");
  const Outcome done = line_.run("export away.csv --scene post.yaml --to csv --out out");
  EXPECT_EQ(done.exit_code, 1);
  EXPECT_THAT(done.out, AllOf(HasSubstr("shoulder"), HasSubstr("away from the start")));
  EXPECT_FALSE(fs::exists(line_.folder() / "out"));
}

TEST_F(Export, RefusesBadInputInWords) {
  const auto refusal = [&](const std::string& arguments) {
    const Outcome done = line_.run("export " + arguments + " --out out");
    EXPECT_EQ(done.exit_code, 3) << arguments;
    EXPECT_THAT(done.out, IsEmpty());
    EXPECT_FALSE(fs::exists(line_.folder() / "out"));
    return done.err;
  };
  EXPECT_THAT(refusal("path.csv --scene post.yaml --to cvs"),
              AllOf(HasSubstr("cvs"), HasSubstr("csv")));
  line_.write("nan.csv", "shoulder,elbow,thumb,left,right\n-0.4,0,0,0,0\n0.4,nan,0,0,0\n");
  EXPECT_THAT(refusal("nan.csv --scene post.yaml --to csv"),
              AllOf(HasSubstr("nan.csv:3"), HasSubstr("elbow")));
  line_.write("far.csv", "shoulder,elbow,thumb,left,right\n-0.4,0,0,0,0\n9.4,0,0,0,0\n");
  EXPECT_THAT(refusal("far.csv --scene post.yaml --to csv"),
              AllOf(HasSubstr("far.csv"), HasSubstr("shoulder"), HasSubstr("9.4")));
  line_.write("odd.csv", "a,b\n-0.4,0\n0.4,0\n");
  EXPECT_THAT(refusal("odd.csv --scene post.yaml --to csv"), HasSubstr("odd.csv"));
  for (const std::string format : {"val3", "urscript", "urscript-servo", "krl", "rapid"}) {
    const std::string command = "path.csv --scene post.yaml --to " + format;
    EXPECT_THAT(refusal(command), HasSubstr("--any-robot"));
    EXPECT_THAT(refusal(command + " --any-robot"), HasSubstr("6 revolute joints"));
  }
  EXPECT_THAT(refusal("path.csv --scene post.yaml --to franka --any-robot"),
              HasSubstr("7 revolute joints"));
}

TEST_F(Export, RefusesWrongUsage) {
  for (const char* option : {"--speed 0", "--speed 2", "--speed nan", "--period-ms 0",
                             "--deviation 0", "--no-blend --deviation 0.1"}) {
    const Outcome done = line_.run(std::string("time path.csv --scene post.yaml ") + option);
    EXPECT_EQ(done.exit_code, 2) << option;
  }
}

class ExportOfScene : public testing::TestWithParam<std::string> {};

TEST_P(ExportOfScene, WorksForEveryFormat) {
  const CommandLine line;
  const std::string scene = (source_dir() / "scenes" / (GetParam() + ".yaml")).string();
  const Outcome plan = line.run("plan " + scene + " --out path.csv");
  ASSERT_EQ(plan.exit_code, 0) << plan.err;
  for (const auto& [format, file] :
       {std::pair("csv", "path.csv"), std::pair("split", "path_hand.csv"),
        std::pair("val3", "path/path.dtx"), std::pair("ros", "path_ros2.yaml"),
        std::pair("moveit", "path_display_ros2.yaml")}) {
    const Outcome done = line.run("export path.csv --scene " + scene + " --to " + format +
                                  " --out out --report report.json");
    EXPECT_EQ(done.exit_code, 0) << format << ": " << done.out << done.err;
    EXPECT_TRUE(fs::is_regular_file(line.folder() / "out" / file)) << file;
    const auto report = nlohmann::json::parse(line.read("report.json"));
    EXPECT_LE(report["velocity"]["share"], 1.001);
    EXPECT_LE(report["acceleration"]["share"], 1.001);
    EXPECT_GT(report["min_clearance_mm"], 0.04);
  }
  const Outcome check = line.run("check " + scene + " out/path.csv");
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
}

INSTANTIATE_TEST_SUITE_P(Scenes, ExportOfScene,
                         testing::Values("can_in_box", "can_on_table", "cans_in_shelf",
                                         "cans_on_desk", "t_shape"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace handway::test
