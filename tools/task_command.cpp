#include "commands.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/paths/path_file.h"
#include "handway/planning/tasks/task.h"
#include "handway/planning/timing/time_path.h"
#include "numbers.h"
#include "printing.h"
#include "task_request.h"
#include "terminal.h"
#include "version.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <filesystem>
#include <iterator>
#include <memory>
#include <stop_token>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using planning::TaskPlan;
using planning::TaskStage;
using planning::TimedPath;

struct TaskCommand {
  TaskRequest request;
  double speed = 1.0;
  fs::path out;
};

/// A stage, timed.
struct TimedStage {
  const TaskStage& stage;
  std::string file;  ///< Its name without an ending: "01-approach".
  TimedPath timed;
};

std::vector<TimedStage> timed_stages(const TaskPlan& plan, double speed) {
  std::vector<TimedStage> stages;
  for (const TaskStage& stage : plan.stages) {
    std::string file = fmt::format("{:02}-{}", stages.size() + 1, to_string(stage.kind));
    planning::TimingOptions timing;
    timing.speed = speed;
    TimedPath timed = time_stage(stage, planning::motion_name(file), timing);
    stages.push_back({stage, std::move(file), std::move(timed)});
  }
  return stages;
}

// Rows of all stages: the stage, seconds from the begin of the task, and the joints that move.
std::string program_csv(const std::vector<TimedStage>& stages) {
  const geometric::RobotModel& model = *stages.front().timed.motion.model;
  std::string text = "stage,time";
  for (int v = 0; v < model.variable_count(); ++v) {
    text += "," + model.variable(v).name;
  }
  text += '\n';
  double begin = 0.0;
  for (const TimedStage& stage : stages) {
    const planning::Trajectory& trajectory = stage.timed.motion.trajectory;
    for (const planning::TrajectoryPoint& point : trajectory.points) {
      if (begin > 0.0 && point.time == 0.0) {
        continue;  // the end of the stage before
      }
      fmt::format_to(std::back_inserter(text), "{},{}", to_string(stage.stage.kind),
                     planning::csv_time(begin + point.time));
      for (const double value : point.position) {
        fmt::format_to(std::back_inserter(text), ",{}", value);
      }
      text += '\n';
    }
    begin += trajectory.duration();
  }
  return text;
}

Json list_of(const Eigen::VectorXd& v) { return std::vector<double>(v.begin(), v.end()); }

Json json_of(const planning::StageTrials& trials) {
  return {{"step", trials.step + 1}, {"stage", to_string(trials.kind)},
          {"tried", trials.tried},   {"failed", trials.failed},
          {"reason", trials.reason}, {"configuration", list_of(trials.q)}};
}

Json json_of(const TimedStage& stage) {
  const planning::PreflightReport& checked = stage.timed.preflight;
  Json json = {{"step", stage.stage.step + 1},
               {"stage", to_string(stage.stage.kind)},
               {"scene", stage.file + ".yaml"},
               {"path", stage.file + ".csv"},
               {"carried", stage.stage.carried},
               {"waypoints", stage.stage.path.waypoints.size()},
               {"deviation_mm", geometric::millimetres(stage.stage.deviation)},
               {"cleared", stage.timed.cleared()},
               {"duration_s", checked.duration},
               {"min_clearance_mm", geometric::millimetres(checked.min_clearance)},
               {"closest_pair", checked.closest_pair}};
  if (stage.stage.squeezed.size() > 0) {
    json["squeeze"] = list_of(stage.stage.squeezed);
  }
  return json;
}

std::string report_of(const TaskCommand& command, const planning::Task& task, const TaskPlan& plan,
                      const std::vector<TimedStage>& stages) {
  Json steps = Json::array();
  for (const planning::TaskStep& step : task) {
    steps.push_back(to_string(step));
  }
  Json planned = Json::array();
  double duration = 0.0;
  for (const TimedStage& stage : stages) {
    planned.push_back(json_of(stage));
    duration += stage.timed.preflight.duration;
  }
  Json trials = Json::array();
  for (const planning::StageTrials& one : plan.trials) {
    trials.push_back(json_of(one));
  }
  const Json report = {{"solved", plan.solved},
                       {"reason", plan.reason},
                       {"steps", steps},
                       {"stages", planned},
                       {"trials", trials},
                       {"duration_s", duration},
                       {"seed", command.request.options.seed},
                       {"threads", command.request.options.threads},
                       {"time_s", plan.time_s},
                       {"version", kVersion}};
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void print_stages(const planning::Task& task, const std::vector<TimedStage>& stages) {
  print_out("{:<24} {:<9} {:>9} {:>8} {:>10}  {}\n", "step", "stage", "waypoints", "time, s",
            "clear, mm", "nearest");
  for (const TimedStage& stage : stages) {
    const planning::PreflightReport& checked = stage.timed.preflight;
    print_out("{:<24} {:<9} {:>9} {:>8.2f} {:>10.2f}  {}\n", to_string(task[stage.stage.step]),
              to_string(stage.stage.kind), stage.stage.path.waypoints.size(), checked.duration,
              geometric::millimetres(checked.min_clearance), checked.closest_pair);
  }
}

// Writes the scene and the path of each stage, and all of them as one table.
void write_stages(const fs::path& folder, const std::vector<TimedStage>& stages) {
  for (const TimedStage& stage : stages) {
    geometric::write_scene(*stage.stage.state.scene, folder / (stage.file + ".yaml"));
    planning::write_path_csv(stage.stage.path, *stage.timed.motion.model,
                             folder / (stage.file + ".csv"));
  }
  geometric::replace_file(folder / "task.csv", program_csv(stages));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw geometric::OutputError(
        {folder.string(), "", error.message(), "a folder that can be made", "Choose another one"});
  }
}

// Returns whether all stages pass the pre-flight check, and names those that do not.
bool are_cleared(const std::vector<TimedStage>& stages) {
  bool cleared = true;
  for (const TimedStage& stage : stages) {
    if (!stage.timed.cleared()) {
      print_error("handway: the stage {} does not pass the pre-flight check. {}\n", stage.file,
                  to_text(stage.timed.preflight));
      cleared = false;
    }
  }
  return cleared;
}

int plan(TaskCommand& command) {
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  if (!command.out.empty()) {
    make_folder(command.out);
  }
  std::stop_source stop;
  const StopsOnInterrupt guard(stop);
  const auto [task, plan] = plan_requested(command.request, plugins, stop.get_token());
  const std::vector<TimedStage> stages = timed_stages(plan, command.speed);
  if (!command.out.empty()) {
    geometric::replace_file(command.out / "report.json", report_of(command, task, plan, stages));
  }
  if (!plan.solved) {
    return print_failure(task, plan);
  }
  print_stages(task, stages);
  print_out("Planned in {:.2f} s\n", plan.time_s);
  if (!are_cleared(stages)) {
    return kNoPath;
  }
  if (!command.out.empty()) {
    write_stages(command.out, stages);
  }
  return kDone;
}

}  // namespace

void add_task_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<TaskCommand>();
  CLI::App* task = app.add_subcommand("task", "Plan a task: pick an object, carry it and place it");
  add_task_request(*task, command->request);
  task->add_option("--speed", command->speed, "Share of full speed, in (0, 1]")
      ->check(number_in(1e-3, 1.0))
      ->capture_default_str();
  task->add_option("--out", command->out,
                   "Folder for the report, and the stages' scenes and paths");
  task->callback([command, &exit_code] { exit_code = plan(*command); });
}

}  // namespace handway::tools
