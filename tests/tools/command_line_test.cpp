/// The contract of the command line: exit codes, messages and files.
#include "command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <cstdlib>
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

enum ExitCode {
  kDone = 0,
  kNoPath = 1,
  kNotWritten = 1,
  kWrongUsage = 2,
  kInvalidInput = 3,
  kInvalidQuery = 4
};

class Handway : public testing::Test {
 protected:
  // Exit code 3, one message on stderr that names all of `words`, nothing on stdout.
  template <typename... Words>
  void expect_refusal(const std::string& arguments, const Words&... words) const {
    expect_failure(kInvalidInput, arguments, words...);
  }
  template <typename... Words>
  void expect_failure(ExitCode code, const std::string& arguments, const Words&... words) const {
    const Outcome run = line_.run(arguments);
    EXPECT_EQ(run.exit_code, code) << arguments << "\n" << run.err;
    EXPECT_THAT(run.err, AllOf(StartsWith("handway: "), HasSubstr(words)...));
    EXPECT_THAT(run.out, IsEmpty());
  }

  CommandLine line_;
};

TEST_F(Handway, PlansAndChecks) {
  const Outcome plan = line_.run("plan post.yaml --seed 3 --out path.csv --report report.json");
  EXPECT_EQ(plan.exit_code, kDone) << plan.err;
  EXPECT_THAT(plan.out, Not(IsEmpty()));
  EXPECT_THAT(plan.err, IsEmpty());
  EXPECT_THAT(line_.read("path.csv"), StartsWith("time,shoulder,elbow"));
  const Outcome check = line_.run("check post.yaml path.csv");
  EXPECT_EQ(check.exit_code, kDone) << check.out << check.err;
  EXPECT_THAT(check.out, HasSubstr("valid"));
}

TEST_F(Handway, NamesJointsThatAPathHasNot) {
  line_.write("arm.csv", "time,shoulder\n0,0\n1,0\n");
  const Outcome check = line_.run("check post.yaml arm.csv");
  EXPECT_EQ(check.exit_code, kNoPath) << "it does not end at the goal";
  EXPECT_THAT(check.err, AllOf(HasSubstr("elbow"), HasSubstr("stay at the start")));
}

// Names in files can't steer the terminal.
TEST_F(Handway, PrintsTextFromFilesAsText) {
  line_.write("arm.urdf", R"(<robot name="arm"><link name="foot"/><link name="rod"><collision>
    <geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
    <joint name="lift" type="prismatic"><parent link="foot"/><child link="rod"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/></joint></robot>)");
  line_.write("red.yaml", R"(handway: 1
name: "\e[31mred\e[0m\a\u202E"
robots: [{name: arm, model: arm.urdf}]
objects: [{name: "\e[31mred\e[0m\a\u202E", sphere: {radius: 0.05}, pose: {xyz: [0, 0, 0.5]}}]
start: {lift: 0}
goal: {lift: 0.5}
)");
  for (const char* arguments :
       {"info red.yaml", "info red.yaml --json", "plan red.yaml",
        "plan \"$(printf 'no\\033[31mfile.yaml')\"",
        "plan red.yaml --planner \"$(printf '\\033[31m')\"", "\"$(printf '\\033[31m')\""}) {
    const Outcome run = line_.run(arguments);
    for (const std::string& text : {run.out, run.err}) {
      EXPECT_THAT(text, Not(HasSubstr("\x1B"))) << arguments;
      EXPECT_THAT(text, Not(HasSubstr("\a"))) << arguments;
      EXPECT_THAT(text, Not(HasSubstr("\u202E"))) << arguments;
    }
  }
  EXPECT_THAT(line_.run("info red.yaml").out, HasSubstr("\\u001b[31mred"));
  EXPECT_THAT(line_.run("plan red.yaml").err, HasSubstr("\\u001b[31mred"));
}

TEST_F(Handway, NamesAnUnknownCommand) {
  const Outcome run = line_.run("juggle post.yaml");
  EXPECT_EQ(run.exit_code, kWrongUsage);
  EXPECT_THAT(run.err, AllOf(HasSubstr("unknown command \"juggle\""), HasSubstr("--help")));
}

TEST_F(Handway, NamesTheOptionThatIsMissingThoughThereIsTooMuchElse) {
  const Outcome run = line_.run("export path.csv post.yaml --to csv --out files");
  EXPECT_EQ(run.exit_code, kWrongUsage);
  EXPECT_THAT(run.err, AllOf(HasSubstr("--scene is required"), Not(HasSubstr("unknown command"))));
}

// The saved problems help to analyse errors of other users.
TEST_F(Handway, KeepsTheProblemsThatItPlansWhereAsked) {
  ::setenv("HANDWAY_LOG_PROBLEMS", (line_.folder() / "log").c_str(), 1);
  const Outcome plan = line_.run("plan post.yaml --seed 3 --set smoothing_checks=50 --out a.csv");
  ::unsetenv("HANDWAY_LOG_PROBLEMS");
  ASSERT_EQ(plan.exit_code, kDone) << plan.err;
  std::vector<fs::path> problems(fs::directory_iterator(line_.folder() / "log"), {});
  ASSERT_EQ(problems.size(), 1U);
  const std::string kept = fs::relative(problems.front(), line_.folder()).string();
  std::string again = line_.read(kept + "/command.txt");
  ASSERT_THAT(again, StartsWith("handway plan scene.yaml --planner auto --seed 3"));
  again.pop_back();  // the end of the line
  again.replace(0, std::string("handway plan scene.yaml").size(), "plan " + kept + "/scene.yaml");
  ASSERT_EQ(line_.run(again + " --out b.csv").exit_code, kDone) << again;
  EXPECT_EQ(line_.read("b.csv"), line_.read("a.csv"));
}

TEST_F(Handway, ReportsWithTheKeysOfTheContract) {
  ASSERT_EQ(line_.run("plan post.yaml --planner pmd-prm --seed 3 --set k=5 --report report.json")
                .exit_code,
            kDone);
  const auto report = nlohmann::json::parse(line_.read("report.json"));
  for (const char* key :
       {"solved", "reason", "planner", "seed", "threads", "time_s", "smoothing_s", "load_s",
        "path_nodes", "certificate", "human_likeness", "statistics", "parameters", "version"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_TRUE(report["human_likeness"]["to_recorded"].is_null()) << "the basis keeps no postures";
  EXPECT_EQ(report["solved"], true);
  EXPECT_EQ(report["planner"], "pmd-prm");
  EXPECT_EQ(report["seed"], 3);
  EXPECT_EQ(report["threads"], 1);
  EXPECT_GE(report["path_nodes"], 2);
  EXPECT_EQ(report["parameters"]["k"], 5);
  for (const char* key : {"resolution_mm", "resolution_at_start_mm", "resolution_at_goal_mm",
                          "min_clearance_mm", "checks"}) {
    EXPECT_GT(report["certificate"][key], 0) << key;
  }
  for (const char* key : {"samples", "nodes", "edges", "checks", "nodes_per_pmds", "final_rho_a"}) {
    EXPECT_TRUE(report["statistics"].contains(key)) << key;
  }
}

TEST_F(Handway, FindsTheSamePathWithOneThreadAndTwo) {
  for (const std::string planner :
       {"auto", "pmd-prm", "full-prm", "pmd-rrt-connect", "pmd-lazy", "rrt-connect"}) {
    const std::string plan = "plan post.yaml --planner " + planner + " --seed 5 --out ";
    ASSERT_EQ(line_.run(plan + "one.csv --threads 1").exit_code, kDone) << planner;
    ASSERT_EQ(line_.run(plan + "two.csv --threads 2").exit_code, kDone) << planner;
    EXPECT_EQ(line_.read("one.csv"), line_.read("two.csv")) << planner;
  }
}

TEST_F(Handway, FailsWhereItsOutputCanNotBeWritten) {
  ASSERT_EQ(line_.run("plan post.yaml --out path.csv").exit_code, kDone);
  for (const std::string arguments :
       {"info post.yaml", "info --json post.yaml", "plan post.yaml", "check post.yaml path.csv",
        "time path.csv --scene post.yaml", "--help", "--version"}) {
    const Outcome run = line_.run(arguments + " >/dev/full 2>stderr.txt #");
    EXPECT_EQ(run.exit_code, kNotWritten) << arguments;
    EXPECT_THAT(run.err, HasSubstr("standard output can't be written")) << arguments;
  }
  EXPECT_EQ(line_.run("plan post.yaml --out none/path.csv").exit_code, kNotWritten);
  EXPECT_EQ(line_.run("export path.csv --scene post.yaml --to csv --out path.csv/x").exit_code,
            kNotWritten);
}

// A goal that is given on the command line alone: what is asked of the path needs none.
TEST_F(Handway, NeedsNoGoalForAPathThatIsThere) {
  line_.write("scene.yaml", line_.read("post.yaml"));
  ASSERT_EQ(line_.run("plan post.yaml --out path.csv").exit_code, kDone);
  const std::string scene = line_.read("scene.yaml");
  const std::size_t goal = scene.find("goal:");
  ASSERT_NE(goal, std::string::npos);
  std::size_t end = scene.find('\n', goal);
  while (end + 1 < scene.size() && scene[end + 1] == ' ') {  // what is indented belongs to the goal
    end = scene.find('\n', end + 1);
  }
  line_.write("scene.yaml", scene.substr(0, goal) + scene.substr(end + 1));
  for (const std::string arguments :
       {"check scene.yaml path.csv", "time path.csv --scene scene.yaml",
        "export path.csv --scene scene.yaml --to csv --out motion"}) {
    const Outcome run = line_.run(arguments);
    EXPECT_EQ(run.exit_code, kDone) << arguments << run.err;
  }
  EXPECT_EQ(line_.run("plan scene.yaml").exit_code, kInvalidInput);
}

TEST_F(Handway, SaysThatThereIsNoPath) {
  const Outcome run =
      line_.run("plan walled.yaml --set max_samples=100 --out path.csv --report report.json");
  EXPECT_EQ(run.exit_code, kNoPath);
  EXPECT_THAT(run.err, HasSubstr("samples"));
  EXPECT_FALSE(fs::exists(line_.folder() / "path.csv")) << "no path, no file";
  const auto report = nlohmann::json::parse(line_.read("report.json"));
  EXPECT_EQ(report["solved"], false);
  EXPECT_FALSE(report["reason"].get<std::string>().empty());
  EXPECT_EQ(report["path_nodes"], 0);
  EXPECT_EQ(line_.run("plan walled.yaml --time-limit 0.1").exit_code, kNoPath);
}

TEST_F(Handway, SaysThatAPathIsNotValid) {
  const std::string header = "time,shoulder,elbow,thumb,left,right\n";
  line_.write("path.csv", header + "0,-0.4,0,0,0,0\n1,0.4,0,0,0,0\n");
  const Outcome run = line_.run("check post.yaml path.csv");
  EXPECT_EQ(run.exit_code, kNoPath);
  EXPECT_THAT(run.out, AllOf(HasSubstr("NOT VALID"), HasSubstr("with post")));
}

TEST_F(Handway, RefusesWrongUsage) {
  for (const std::string arguments : {"",
                                      "fly",
                                      "plan",
                                      "plan open.yaml --fast",
                                      "plan open.yaml --threads 0",
                                      "plan open.yaml --threads two",
                                      "plan open.yaml --seed -1",
                                      "plan open.yaml --time-limit 0",
                                      "plan open.yaml --seed 18446744073709551616",
                                      "plan open.yaml --time-limit nan",
                                      "plan open.yaml --set rho_a",
                                      "plan open.yaml --out",
                                      "check open.yaml",
                                      "check open.yaml path.csv --resolution-mm 0",
                                      "check open.yaml path.csv --resolution-mm -1",
                                      "check open.yaml path.csv --resolution-mm nan",
                                      "check open.yaml path.csv --resolution-mm 1e-12",
                                      "info",
                                      "pca one.csv --from nan",
                                      "pca one.csv --low-pass 1e-300",
                                      "glove generate --out g.csv --samples 5 --rate 1e-300"}) {
    const Outcome run = line_.run(arguments);
    EXPECT_EQ(run.exit_code, kWrongUsage) << arguments << "\n" << run.out << run.err;
    EXPECT_THAT(run.err, Not(IsEmpty())) << arguments;
  }
}

TEST_F(Handway, RefusesEmptyTexts) {
  for (const std::string arguments :
       {"plan open.yaml --out ''", "plan open.yaml --report ''", "plan ''", "info ''",
        "plan open.yaml --robot ''", "bench open.yaml --out ''", "bench ''",
        "edit drop open.yaml --out ''", "recording convert '' --out a.csv"}) {
    const Outcome run = line_.run(arguments);
    EXPECT_EQ(run.exit_code, kWrongUsage) << arguments << "\n" << run.out << run.err;
    EXPECT_THAT(run.err, HasSubstr("found an empty text, expected a value")) << arguments;
  }
  EXPECT_THAT(line_.run("plan open.yaml --out ''").err,
              StartsWith("--out: found an empty text, expected a value"));
}

TEST_F(Handway, HelpsAndNamesItsVersion) {
  for (const std::string arguments : {"--help", "plan --help", "check --help", "info --help"}) {
    const Outcome run = line_.run(arguments);
    EXPECT_EQ(run.exit_code, kDone) << arguments;
    EXPECT_THAT(run.out, HasSubstr("handway")) << arguments;
  }
  EXPECT_EQ(line_.run("--version").exit_code, kDone);
}

TEST_F(Handway, RefusesUnknownPlannersAndParameters) {
  expect_refusal("plan open.yaml --planner pmd-prn", "pmd-prn", "pmd-prm, full-prm");
  expect_refusal("plan open.yaml --planner pmd-prm --set rho=1", "rho", "rho_a");
  expect_refusal("plan open.yaml --planner pmd-prm --set rho_a=2", "rho_a", "\"2\"",
                 "from 1e-05 to 0.5");
  expect_refusal("plan open.yaml --planner pmd-prm --set k=nan", "a whole number");
}

TEST_F(Handway, NamesAFileThatIsNotThere) {
  for (const std::string command : {"plan none.yaml", "info none.yaml", "check none.yaml p.csv"}) {
    expect_refusal(command, "none.yaml");
  }
  expect_refusal("check open.yaml none.csv", "none.csv");
  expect_refusal("plan .", "");
}

TEST_F(Handway, NamesAMissingMesh) {
  line_.write("scene.yaml", line_.read("open.yaml"));
  line_.replace("scene.yaml", "objects:", "objects:\n  - {name: can, mesh: {file: can.obj}}");
  expect_refusal("plan scene.yaml", "scene.yaml", "can.obj");
}

TEST_F(Handway, NamesTheLineOfABrokenScene) {
  line_.write("scene.yaml", "handway: 1\nrobots: [\n");
  expect_refusal("plan scene.yaml", "scene.yaml:");
  line_.write("scene.yaml", "handway: 1\nrobots:\n  - model: open_planar.urdf\nspeed: 3\n");
  expect_refusal("info scene.yaml", "scene.yaml:4", "speed");
  line_.write("scene.yaml", "handway: 1\nrobots:\n  - model: none.urdf\n");
  expect_refusal("info scene.yaml", "none.urdf");
}

TEST_F(Handway, NamesAnUnknownJoint) {
  line_.replace("open.yaml", "shoulder", "sholder");
  expect_refusal("plan open.yaml", "open.yaml:", "sholder", "shoulder");
}

TEST_F(Handway, NamesTheLineOfABrokenRobot) {
  line_.replace("open_planar.urdf", "</link>", "</lnk>");
  expect_refusal("plan open.yaml", "open_planar.urdf:");
  line_.write("robot.urdf", "<robot name=\"r\"><link name=\"a\"/><joint name=\"j\"/></robot>");
  expect_refusal("info robot.urdf", "robot.urdf", "j");
}

TEST_F(Handway, NamesWhatIsWrongWithABasis) {
  line_.replace("basis.yaml", "right", "rigth");
  expect_refusal("plan open.yaml", "rigth");
}

TEST_F(Handway, RefusesFilesOfNoKnownFormat) {
  line_.write("problem.xml", "<Problem><Robot");
  expect_refusal("plan problem.xml", "problem.xml");
  line_.write("notes.txt", "hello");
  expect_refusal("info notes.txt", "notes.txt");
  line_.write("empty.yaml", "");
  expect_refusal("info empty.yaml", "empty.yaml");
}

TEST_F(Handway, NamesLineAndColumnOfABrokenPath) {
  const std::string header = "time,shoulder,elbow,thumb,left,right\n";
  line_.write("path.csv", header + "0,-0.4,0,0,0,0\n1,nan,0,0,0,0\n");
  expect_refusal("check post.yaml path.csv", "path.csv:3", "column shoulder", "nan");
  line_.write("path.csv", header + "0,-0.4,0,0,0\n1,0,0,0,0,0\n");
  expect_refusal("check post.yaml path.csv", "path.csv:2", "5 values");
  line_.write("path.csv", "time,a,b\n0,-0.4,0\n1,0.4,0\n");
  expect_refusal("check post.yaml path.csv", "path.csv:1", "column \"a\"");
}

constexpr const char* kTray =
    "  - {name: tray, box: {size: [0.02, 0.02, 0.02]}, attach: {link: upper}}\n"
    "constraints:\n"
    "  - {name: ahead, body: upper, upright: {axis: [1, 0, 0], direction: [1, 0, 0], "
    "angle_deg: 25}}\n"
    "start:";

TEST_F(Handway, KeepsConstraintsAndRefusesWhatViolatesThem) {
  ASSERT_EQ(line_.run("plan post.yaml --out free.csv").exit_code, kDone);
  line_.replace("post.yaml", "start:", kTray);
  EXPECT_EQ(line_.run("plan post.yaml --out path.csv").exit_code, kDone);
  EXPECT_EQ(line_.run("check post.yaml path.csv").exit_code, kDone);
  line_.replace("post.yaml", "angle_deg: 25", "angle_deg: 20");
  const Outcome check = line_.run("check post.yaml path.csv");
  EXPECT_EQ(check.exit_code, kNoPath);
  EXPECT_THAT(check.out,
              AllOf(HasSubstr("NOT VALID"), HasSubstr("Constraint ahead is violated after")));
  const Outcome exported = line_.run("export path.csv --scene post.yaml --to csv --out exported");
  EXPECT_EQ(exported.exit_code, kNoPath);
  EXPECT_THAT(exported.out + exported.err, HasSubstr("violates constraint ahead"));
  const Outcome plan = line_.run("plan post.yaml");
  EXPECT_EQ(plan.exit_code, kInvalidQuery);
  EXPECT_THAT(plan.err,
              HasSubstr("start violates constraint ahead: the axis of upper is 22.92° off, at most "
                        "20° are allowed"));
  EXPECT_THAT(line_.run("info post.yaml").out,
              AllOf(HasSubstr("constraint ahead: orientation of upper along the path\n"),
                    HasSubstr("start: VIOLATES constraint ahead")));
  EXPECT_EQ(nlohmann::json::parse(line_.run("info post.yaml --json").out)["constraints"][0]["kind"],
            "orientation");
}

TEST_F(Handway, KeepsWhatTheCommandLineNamesUpright) {
  line_.replace("post.yaml", "start:", kTray);
  EXPECT_EQ(line_.run("plan post.yaml --upright tray:5 --upright palm:5 --out path.csv").exit_code,
            kDone)
      << "a flat arm keeps everything upright";
  EXPECT_EQ(line_.run("check post.yaml path.csv --upright tray:5").exit_code, kDone);
  expect_refusal("plan post.yaml --upright trai:5", "--upright trai:5", "not in the scene",
                 "Did you mean \"tray\"?");
  expect_refusal("plan post.yaml --upright post:5", "post, which is not attached to a link");
  for (const std::string bad : {"tray", "tray:", "tray:0", "tray:181", "tray:nan", ":5"}) {
    EXPECT_EQ(line_.run("plan post.yaml --upright " + bad).exit_code, kWrongUsage) << bad;
  }
}

TEST_F(Handway, PlansForAGroupInPlaceOfTheScenes) {
  const std::string plan = "plan open.yaml --out path.csv --report report.json";
  const Outcome run = line_.run(plan + " --group shoulder,hand");
  ASSERT_EQ(run.exit_code, kDone) << run.err;
  const auto report = nlohmann::json::parse(line_.read("report.json"));
  EXPECT_EQ(report["group"], nlohmann::json({"shoulder", "hand"}));
  EXPECT_EQ(report["moving"].size(), 4U) << run.out << line_.read("report.json");
  EXPECT_EQ(line_.run("check open.yaml path.csv --group shoulder --group hand").exit_code, kDone);
  EXPECT_EQ(line_.run("check open.yaml path.csv --group elbow").exit_code, kNoPath);
  expect_refusal(plan + " --group shuolder", "joint that moves: arm, hand",
                 "Did you mean \"shoulder\"?");
}

TEST_F(Handway, RefusesAGroupThatIsNotThereWhereverItReadsAScene) {
  for (const std::string command :
       {"plan open.yaml", "check open.yaml path.csv", "time path.csv --scene open.yaml",
        "export path.csv --scene open.yaml --to csv --out out",
        "export --scene open.yaml --to moveit-scene --out out",
        "send path.csv --scene open.yaml --to arm://localhost:1", "bench open.yaml --seeds 1"}) {
    expect_refusal(command + " --group nobody", "nobody");
  }
}

TEST_F(Handway, ShowsWhatMoves) {
  line_.replace("open.yaml", "goal:", "group: [arm, thumb]\ngoal:");
  EXPECT_THAT(line_.run("info open.yaml").out, HasSubstr("moves: arm, thumb (3 of 5 joints)\n"));
  EXPECT_EQ(nlohmann::json::parse(line_.run("info open.yaml --json").out)["group"],
            nlohmann::json({"arm", "thumb"}));
}

TEST_F(Handway, PlansToPosesOfALink) {
  const std::string goal = " --goal-pose 0.549876,0.055172,0,0,0,-17.18873";
  const Outcome plan = line_.run("plan open.yaml" + goal + " --out path.csv --report report.json");
  EXPECT_EQ(plan.exit_code, kDone) << plan.err;
  EXPECT_THAT(plan.out, HasSubstr("It ends at goal pose of link palm"));
  EXPECT_THAT(line_.read("report.json"),
              AllOf(HasSubstr("\"goal\": {"), HasSubstr("\"link\": \"palm\"")));
  EXPECT_EQ(line_.run("check open.yaml path.csv" + goal).exit_code, kDone);
  EXPECT_EQ(line_.run("check open.yaml path.csv").exit_code, kNoPath) << "the scene's is elsewhere";
  const std::string behind = " --goal-pose -9,0,0 --goal-pose lower:-0.18,0.24,0 --goal-link thumb";
  const Outcome other = line_.run("plan open.yaml" + behind + " --out path.csv");
  EXPECT_EQ(other.exit_code, kDone) << other.err;
  EXPECT_THAT(other.out, HasSubstr("It ends at goal pose 2 of link lower"));
  EXPECT_EQ(line_.run("check open.yaml path.csv" + behind).exit_code, kDone);
}

TEST_F(Handway, TellsInHowManyConfigurationsAGoalPoseIsFree) {
  line_.replace(
      "open.yaml", "goal:",
      "goal_pose:\n  - {link: palm, xyz: [0.549876, 0.055172, 0], rpy_deg: [0, 0, -17.18873]}"
      "\n  - {link: palm, xyz: [2, 0, 0]}\ngoal:");
  const Outcome text = line_.run("info open.yaml");
  EXPECT_THAT(text.out,
              AllOf(HasSubstr("goal pose 1 of link palm: 1 free configuration found\n"),
                    HasSubstr("goal pose 2 of link palm: 0 free configurations found\n")));
  const auto info = nlohmann::json::parse(line_.run("info open.yaml --json").out);
  EXPECT_EQ(info["goal_poses"][0]["configurations"], 1);
  EXPECT_EQ(info["goal_fault"], "");
  EXPECT_TRUE(info["goal"].is_null());
  EXPECT_EQ(line_.run("plan open.yaml --out path.csv").exit_code, kDone);
  EXPECT_EQ(line_.run("check open.yaml path.csv").exit_code, kDone);
}

TEST_F(Handway, AsksWhichHandAPoseIsForWhereSeveralMayBeMeant) {
  line_.write("two.yaml", R"(handway: 1
robots:
  - {name: left, model: ur5e_class}
  - {name: left_hand, model: leap_class_right, mount: {robot: left}}
  - {name: right, model: ur5e_class, mount: {robot: left, link: base_link, pose: {xyz: [0, -1.5, 0]}}}
  - {name: right_hand, model: leap_class_right, mount: {robot: right}}
start: {joint_2: -1.5, right/joint_2: -1.5}
)");
  const std::string pose = " --goal-pose 0.5,-1.5,0.5";
  expect_refusal("plan two.yaml" + pose, "no link, of a robot with 2 hands",
                 "the link: left_hand/palm, right_hand/palm", "--goal-link");
  const Outcome right = line_.run("plan two.yaml --group right" + pose + " --out path.csv");
  EXPECT_EQ(right.exit_code, kDone) << right.err;
  EXPECT_EQ(line_.run("check two.yaml path.csv --goal-link right_hand/palm" + pose).exit_code,
            kDone);
}

TEST_F(Handway, SaysWhyAPoseCannotBeComeTo) {
  const Outcome far = line_.run("plan open.yaml --goal-pose 0.9,0,0");
  EXPECT_EQ(far.exit_code, kInvalidQuery);
  EXPECT_THAT(far.err, HasSubstr("The goal is out of reach: the nearest configuration that was "
                                 "found misses goal pose of link palm by 300 mm"));
  EXPECT_EQ(line_.run("plan open.yaml --goal-pose 0.62,0,0 --goal-tolerance 25,0").exit_code,
            kDone);
  expect_refusal("plan open.yaml --goal-pose plm:0.3,0,0", "plm, which is no link of the robot",
                 "Did you mean \"palm\"?");
  expect_refusal("plan open.yaml --goal-pose base:0.3,0,0", "base, which no joint moves");
  for (const std::string bad : {"1,2", "1,2,3,4", "1,2,x", "palm:", "1,2,nan", "1e300,0,0"}) {
    EXPECT_EQ(line_.run("plan open.yaml --goal-pose " + bad).exit_code, kWrongUsage) << bad;
  }
}

TEST_F(Handway, RefusesAStartInCollision) {
  line_.replace("post.yaml", "-0.4", "-0.066");
  const Outcome run = line_.run("plan post.yaml --out path.csv --report report.json");
  EXPECT_EQ(run.exit_code, kInvalidQuery) << run.err;
  EXPECT_THAT(run.err,
              AllOf(HasSubstr("start is in collision"), HasSubstr("with post"),
                    HasSubstr("mm into each other at ("), HasSubstr("Nearest free start: ")));
  EXPECT_FALSE(fs::exists(line_.folder() / "path.csv"));
  EXPECT_EQ(nlohmann::json::parse(line_.read("report.json"))["solved"], false);
}

TEST_F(Handway, TakesAClosedShapeForASolidUnlessItIsHollow) {
  ASSERT_EQ(line_.run("plan open.yaml --out path.csv").exit_code, kDone);
  line_.replace("open.yaml", "objects:\n",
                "objects:\n  - name: room\n    box: {size: [20, 20, 20]}\n    solid: true\n");
  const Outcome plan = line_.run("plan open.yaml");
  EXPECT_EQ(plan.exit_code, kInvalidQuery);
  EXPECT_THAT(plan.err, AllOf(HasSubstr("start is in collision"), HasSubstr("with room")));
  const Outcome check = line_.run("check open.yaml path.csv");
  EXPECT_EQ(check.exit_code, kNoPath);
  EXPECT_THAT(check.out, HasSubstr("with room"));
  EXPECT_THAT(line_.run("info open.yaml").out,
              AllOf(HasSubstr("object room: box, 12 triangles, solid"),
                    HasSubstr("start: IN COLLISION"), HasSubstr("goal: IN COLLISION")));
  line_.replace("open.yaml", "solid: true", "solid: false");
  EXPECT_EQ(line_.run("plan open.yaml").exit_code, kDone);
  EXPECT_EQ(line_.run("check open.yaml path.csv").exit_code, kDone);
  EXPECT_THAT(line_.run("info open.yaml").out,
              AllOf(HasSubstr("surface (solid: false)"), HasSubstr("start: free")));
}

TEST_F(Handway, TellsStartAndGoalAsData) {
  line_.replace("post.yaml", "-0.4", "-0.066");
  const Outcome run = line_.run("info post.yaml --json");
  ASSERT_EQ(run.exit_code, kDone) << run.err;
  const auto info = nlohmann::json::parse(run.out);
  EXPECT_EQ(info["start"]["free"], false);
  EXPECT_EQ(info["start"]["pair"][1], "post");
  EXPECT_EQ(info["start"]["distance_mm"], 0.0);
  EXPECT_EQ(info["goal"]["free"], true);
  EXPECT_EQ(info["goal"]["within_limits"], true);
  EXPECT_EQ(info["goal"]["pair"].size(), 2U);
  EXPECT_GT(info["goal"]["distance_mm"], 0.0);
  EXPECT_EQ(info["objects"][0]["solid"], true);
}

TEST_F(Handway, RefusesAGoalOutOfLimits) {
  line_.replace("post.yaml", "shoulder: 0.4", "shoulder: 2.6");
  const Outcome run = line_.run("plan post.yaml");
  EXPECT_EQ(run.exit_code, kInvalidQuery) << run.err;
  EXPECT_THAT(run.err, AllOf(HasSubstr("goal is out of limits"), HasSubstr("shoulder"),
                             HasSubstr("Nearest free goal: shoulder -5.7°")));
}

TEST_F(Handway, SaysThatAPlaceCanNotBeWrittenTo) {
  for (const std::string option : {"--out", "--report"}) {
    const std::string plan = "plan open.yaml " + option;
    expect_failure(kNotWritten, plan + " /dev/full", "/dev/full", "No space left");
    expect_failure(kNotWritten, plan + " none/file", "none/file", "No such file");
    expect_failure(kNotWritten, plan + " .", "directory");
  }
  if (::geteuid() != 0) {  // root may write everywhere
    expect_failure(kNotWritten, "plan open.yaml --out /proc/version", "/proc/version");
  }
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(Handway, SummarisesTheWarningsOfASceneOnce) {
  line_.replace("post_planar.urdf", "<robot", "<robot vendor=\"x\"");
  line_.replace("post_planar.urdf", "</robot>", "<vendor_extension/></robot>");
  ASSERT_EQ(line_.run("plan post.yaml --seed 3 --out path.csv").exit_code, kDone);
  const Outcome info = line_.run("info post.yaml");
  for (const std::string command :
       {"plan post.yaml --seed 3", "check post.yaml path.csv", "time path.csv --scene post.yaml",
        "export path.csv --scene post.yaml --to csv --out folder",
        "send path.csv --scene post.yaml --to arm://127.0.0.1:9"}) {
    const Outcome run = line_.run(command);
    EXPECT_THAT(run.err, AllOf(StartsWith("handway: 1 warning\n"), HasSubstr("vendor_extension")))
        << command;
    EXPECT_THAT(run.out, Not(HasSubstr("vendor_extension"))) << command;
  }
  const std::string& shown = info.out;
  const std::size_t first = shown.find("vendor_extension");
  ASSERT_NE(first, std::string::npos) << shown;
  EXPECT_EQ(shown.find("vendor_extension", first + 1), std::string::npos) << shown;
}

TEST_F(Handway, CountsTheJointsOfAGroupThatMove) {
  line_.write("one.urdf", R"(<robot name="one"><link name="a"/><link name="b"/><link name="c"/>
    <joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint>
    <joint name="k" type="fixed"><parent link="b"/><child link="c"/></joint></robot>)");
  line_.write("one.srdf", R"(<robot name="one"><group name="manipulator">
    <chain base_link="a" tip_link="c"/></group></robot>)");
  EXPECT_THAT(line_.run("info one.urdf").out, HasSubstr("group manipulator: 1 joint\n"));
}

TEST_F(Handway, ShowsWhatAFileHolds) {
  const Outcome scene = line_.run("info post.yaml");
  EXPECT_EQ(scene.exit_code, kDone) << scene.err;
  EXPECT_THAT(scene.out,
              AllOf(HasSubstr("5 independent joints"), HasSubstr("object post: cylinder"),
                    HasSubstr("group hand: 3 joints"), HasSubstr("start: free")));
  const Outcome robot = line_.run("info open_planar.urdf");
  EXPECT_EQ(robot.exit_code, kDone) << robot.err;
  EXPECT_THAT(robot.out, HasSubstr("left_tip"));
}

}  // namespace
}  // namespace handway::test
