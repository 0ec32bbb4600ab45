/// `handway task`: what it writes, and its exit codes.
#include "command_line.h"
#include "handway_test/paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace handway::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class TaskCommand : public testing::Test {
 protected:
  static std::string scene() { return (source_dir() / "scenes" / "can_on_table.yaml").string(); }

  /// The text of the scene before its program, which is last.
  std::string without_program() const {
    const std::string text = line_.read(scene());
    return text.substr(0, text.find("program:"));
  }

  /// The run with a task file of this text.
  Outcome run_file(const std::string& text) const {
    std::ofstream(line_.folder() / "task.yaml") << text;
    return line_.run("task " + scene() + " --task task.yaml --out plan");
  }

  CommandLine line_;
};

TEST_F(TaskCommand, WritesStagesThatPassTheCheck) {
  const Outcome run = line_.run("task " + scene() + " --pick can --place-on table --out plan");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, StartsWith("step "));
  const auto report = nlohmann::json::parse(line_.read("plan/report.json"));
  EXPECT_EQ(report["solved"], true);
  EXPECT_EQ(report["steps"], (nlohmann::json{"pick can", "place on table"}));
  ASSERT_EQ(report["stages"].size(), 8U);
  for (const auto& stage : report["stages"]) {
    const std::string folder = "plan/";
    const Outcome check = line_.run("check " + folder + stage["scene"].get<std::string>() + " " +
                                    folder + stage["path"].get<std::string>());
    EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
    EXPECT_EQ(stage["cleared"], true);
    EXPECT_LE(stage["deviation_mm"], 1.0);
  }
  EXPECT_THAT(line_.read("plan/task.csv"), StartsWith("stage,time,joint_1,"));
}

/// The columns of a table whose last column is text: time, and that text.
std::vector<std::pair<double, std::string>> times_and_stages(const std::string& csv) {
  std::vector<std::pair<double, std::string>> rows;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    rows.emplace_back(std::stod(line), line.substr(line.rfind(',') + 1));
  }
  return rows;
}

TEST_F(TaskCommand, ExportsTheWholeTaskAsOneProgram) {
  const Outcome run =
      line_.run("task " + scene() +
                " --pick can --place-on table --out plan --export csv,val3,ros --export urscript"
                " --gripper-output 1 --any-robot");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* file : {"can_on_table.csv", "can_on_table/runPath.pgx", "can_on_table.script",
                           "can_on_table_stages_ros2.yaml"}) {
    EXPECT_THAT(run.out, HasSubstr(std::string("plan/") + file + "\n"));
  }
  const auto report = nlohmann::json::parse(line_.read("plan/report.json"));
  const auto rows = times_and_stages(line_.read("plan/can_on_table.csv"));
  std::vector<std::string> stages;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_NEAR(rows[i].first, 0.004 * static_cast<double>(i), 1e-6) << "one time axis";
    if (stages.empty() || stages.back() != rows[i].second) {
      stages.push_back(rows[i].second);
    }
  }
  std::vector<std::string> planned;
  for (const auto& stage : report["stages"]) {
    planned.push_back(stage["stage"]);
  }
  EXPECT_EQ(stages, planned);
  EXPECT_NEAR(rows.back().first, report["duration_s"].get<double>(), 1e-6);
  const std::string program = line_.read("plan/can_on_table.script");
  EXPECT_LT(program.find("# stage: close (pick can)"), program.find("out(1, True)"));
  EXPECT_LT(program.find("out(1, True)"), program.find("# attach: can"));
  EXPECT_LT(program.find("# attach: can"), program.find("# stage: lift"));
  EXPECT_LT(program.find("# detach: can"), program.find("out(1, False)"));
}

TEST_F(TaskCommand, WaitsAndSetsOutputs) {
  std::ofstream(line_.folder() / "task.yaml") << R"(handway_task: 1
steps:
  - move: ready
  - output: {name: do3, value: true}
  - wait: 2.5
  - {pick: can, disabled: true}
  - output: {name: lamp, value: 0.5}
  - move: start
)";
  const Outcome run = line_.run("task " + scene() +
                                " --task task.yaml --out plan --export csv,urscript --any-robot");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err,
              testing::AllOf(HasSubstr("warning: csv does not set the output do3 to true"),
                             HasSubstr("warning: urscript does not set the output lamp to 0.5"),
                             testing::Not(HasSubstr("urscript does not set the output do3"))));
  const auto report = nlohmann::json::parse(line_.read("plan/report.json"));
  ASSERT_EQ(report["stages"].size(), 5U);
  EXPECT_EQ(report["stages"][1]["stage"], "output");
  EXPECT_EQ(report["stages"][1]["duration_s"], 0.0);
  EXPECT_EQ(report["stages"][1]["output"]["value"], true);
  EXPECT_NEAR(report["stages"][2]["duration_s"].get<double>(), 2.5, 1e-6);
  const auto rows = times_and_stages(line_.read("plan/can_on_table.csv"));
  std::vector<double> waits;
  for (const auto& [time, stage] : rows) {
    if (stage == "wait") {
      waits.push_back(time);
    }
  }
  ASSERT_EQ(waits.size(), 1U) << "its end; its beginning is the end of the stage before";
  EXPECT_NEAR(rows.back().first, report["duration_s"].get<double>(), 1e-6);
  const std::string program = line_.read("plan/can_on_table.script");
  const std::size_t set = program.find("set_standard_digital_out(3, True)");
  const std::size_t wait = program.find("sleep(2.500000)");
  ASSERT_NE(set, std::string::npos);
  EXPECT_LT(set, wait);
  EXPECT_LT(wait, program.find("# NOT SET: lamp to 0.5"));
  const Outcome check = line_.run("check plan/03-wait.yaml plan/03-wait.csv");
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
}

TEST_F(TaskCommand, RefusesToExportWhatAFormatCanNotHold) {
  const std::string task = "task " + scene() + " --pick can --out plan";
  const Outcome format = line_.run(task + " --export val4");
  EXPECT_EQ(format.exit_code, 3);
  EXPECT_THAT(format.err, HasSubstr("val3"));
  EXPECT_FALSE(std::filesystem::exists(line_.folder() / "plan")) << "before it plans";
  const Outcome robot = line_.run(task + " --export csv,krl");
  EXPECT_EQ(robot.exit_code, 3);
  EXPECT_THAT(robot.err, testing::AllOf(HasSubstr("KUKA"), HasSubstr("--any-robot")));
  EXPECT_FALSE(std::filesystem::exists(line_.folder() / "plan" / "can_on_table.csv"));
  EXPECT_EQ(line_.run("task " + scene() + " --pick can --export csv").exit_code, 2) << "no folder";
  EXPECT_EQ(line_.run(task + " --gripper-output 1").exit_code, 2) << "no format";
  EXPECT_EQ(line_.run(task + " --export val3 --gripper-output -1").exit_code, 2);
}

TEST_F(TaskCommand, KeepsItsTableBesideTheProgramOfASceneOfThatName) {
  std::ofstream(line_.folder() / "task.yaml") << without_program() << "program:\n  - move: ready\n";
  const Outcome run = line_.run("task task.yaml --out plan --export csv");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(line_.read("plan/task.csv"), StartsWith("stage,time,joint_1,"));
  EXPECT_THAT(line_.read("plan/task_program.csv"), StartsWith("time"));
}

TEST_F(TaskCommand, PlansTheProgramsOfAScene) {
  std::ofstream(line_.folder() / "cell.yaml")
      << without_program() << "program:\n  home:\n    - move: start\n  tidy:\n    - pick: can\n";
  const Outcome home = line_.run("task cell.yaml --task home --out plan");
  EXPECT_EQ(home.exit_code, 0) << home.err;
  EXPECT_EQ(nlohmann::json::parse(line_.read("plan/report.json"))["steps"],
            nlohmann::json{"move to start"});
  EXPECT_THAT(line_.read("plan/01-move.yaml"), testing::Not(HasSubstr("program:")));
  const Outcome which = line_.run("task cell.yaml --out plan");
  EXPECT_EQ(which.exit_code, 3);
  EXPECT_THAT(which.err, HasSubstr("one of \"home\", \"tidy\""));
  EXPECT_EQ(line_.run("task cell.yaml --task away --out plan").exit_code, 3);
}

TEST_F(TaskCommand, TellsTheStageThatFails) {
  const Outcome run =
      line_.run("task " + scene() + " --pick can --place-at 5,0,1,0,0,0 --grasps 1 --out plan");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("Step 2, place: in the stage \"lower\""));
  EXPECT_THAT(run.out, HasSubstr("1 failed: The arm does not reach the place"));
  EXPECT_THAT(line_.read("plan/report.json"), HasSubstr("\"solved\": false"));
  EXPECT_FALSE(std::filesystem::exists(line_.folder() / "plan" / "task.csv"));
}

TEST_F(TaskCommand, RefusesTaskFilesByLineAndElement) {
  const auto refusal = [&](const std::string& steps) {
    const Outcome run = run_file("handway_task: 1\nsteps:\n" + steps);
    EXPECT_EQ(run.exit_code, 3) << run.out;
    return run.err;
  };
  EXPECT_THAT(refusal("  - pick: cam\n"), HasSubstr("task.yaml:3: steps[0].pick: found \"cam\""));
  EXPECT_THAT(refusal("  - grab: can\n"), HasSubstr("grab"));
  EXPECT_THAT(refusal("  - {pick: can, place: table}\n"), HasSubstr("a map of 2 keys"));
  EXPECT_THAT(refusal("  - pick: {object: can, lift: -1}\n"), HasSubstr("a length from 0 to 10 m"));
  EXPECT_THAT(refusal("  - place: {lower: 0.1}\n"), HasSubstr("neither on nor pose"));
  EXPECT_THAT(refusal("  - move: hoem\n"), HasSubstr("There are: start"));
  EXPECT_THAT(refusal("  - place: table\n"), HasSubstr("an empty hand"));
  EXPECT_THAT(refusal("  []\n"), HasSubstr("an empty list"));
  EXPECT_EQ(run_file("handway_task: 7\nsteps: [{pick: can}]\n").exit_code, 3);
  EXPECT_EQ(run_file("").exit_code, 3);
  EXPECT_EQ(line_.run("task " + scene() + " --place-on table").exit_code, 2);
  EXPECT_EQ(line_.run("task " + scene() + " --pick can --place-at 0,0,nan,0,0,0").exit_code, 2);
  std::ofstream(line_.folder() / "cell.yaml") << without_program();
  EXPECT_EQ(line_.run("task cell.yaml").exit_code, 2) << "nothing says what the task is";
}

TEST_F(TaskCommand, IsSimulatedWhileTheObjectIsCarried) {
  const std::string task = " --pick can --place-on table --grasps 4";
  const Outcome run = line_.run("simulate " + scene() + task + " --report sim.json");
  if (run.err.find("no plugin that simulates") != std::string::npos) {
    GTEST_SKIP() << "built without MuJoCo";
  }
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("can: held"));
  const auto report = nlohmann::json::parse(line_.read("sim.json"));
  EXPECT_EQ(report["held"], true);
  EXPECT_LT(report["slip_mm"], 5.0);
  EXPECT_GE(report["contacts"].size(), 2U);
  EXPECT_GT(report["torques"]["largest_share"], 0.0);
  const Outcome slippery = line_.run("simulate " + scene() + task + " --payload 9 --friction 0.2");
  EXPECT_EQ(slippery.exit_code, 1) << slippery.out;

  ASSERT_EQ(line_.run("task " + scene() + task + " --out plan").exit_code, 0);
  const Outcome path = line_.run("simulate plan/04-lift.yaml plan/04-lift.csv");
  EXPECT_EQ(path.exit_code, 0) << path.err;
  EXPECT_THAT(path.out, HasSubstr("can: held"));
  const Outcome empty = line_.run("simulate plan/01-approach.yaml plan/01-approach.csv");
  EXPECT_EQ(empty.exit_code, 3);
  EXPECT_THAT(empty.err, HasSubstr("0 objects attached to the robot"));
}

}  // namespace
}  // namespace handway::test
