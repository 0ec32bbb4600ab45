#include "commands.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/paths/path_file.h"
#include "handway/planning/tasks/task.h"
#include "handway/planning/tasks/task_file.h"
#include "handway/planning/timing/time_path.h"
#include "numbers.h"
#include "printing.h"
#include "scene_options.h"
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
  fs::path scene;
  fs::path task;  ///< Empty: the steps below.
  std::string pick;
  std::string place_on;
  std::vector<double> place_at;  ///< m, and degrees; empty: not given.
  std::string then;              ///< Posture at the end; empty: none.
  std::string planner;
  std::vector<std::string> settings;
  std::vector<std::string> group;
  planning::TaskOptions options;
  double speed = 1.0;
  fs::path out;
};

planning::Task task_of(const TaskCommand& command, const geometric::Scene& scene) {
  if (!command.task.empty()) {
    return planning::read_task(command.task, scene);
  }
  if (command.pick.empty() && command.then.empty()) {
    throw CLI::RequiredError("--task, --pick or --then");
  }
  planning::Task task;
  if (!command.pick.empty()) {
    task.emplace_back(planning::PickStep{command.pick});
  }
  if (!command.place_on.empty()) {
    task.emplace_back(planning::PlaceStep{command.place_on});
  }
  if (!command.place_at.empty()) {
    const std::vector<double>& n = command.place_at;
    planning::PlaceStep place;
    place.pose = geometric::pose_from_rpy({n[0], n[1], n[2]}, geometric::radians(n[3]),
                                          geometric::radians(n[4]), geometric::radians(n[5]));
    task.emplace_back(place);
  }
  if (!command.then.empty()) {
    task.emplace_back(planning::move_to_posture(scene, command.then, "--then"));
  }
  return task;
}

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
    TimedPath timed = time_path(planning::make_problem(stage.state.scene, stage.state.basis),
                                stage.path, planning::motion_name(file), timing);
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
               {"min_clearance_mm", checked.min_clearance_mm},
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
                       {"seed", command.options.seed},
                       {"threads", command.options.threads},
                       {"time_s", plan.time_s},
                       {"version", kVersion}};
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void print_trials(const planning::Task& task, const TaskPlan& plan) {
  for (const planning::StageTrials& trials : plan.trials) {
    print_out("  {:<24} {:<9} {:>3} tried, {:>3} failed{}\n", to_string(task[trials.step]),
              to_string(trials.kind), trials.tried, trials.failed,
              trials.reason.empty() ? std::string() : ": " + trials.reason);
  }
}

void print_stages(const planning::Task& task, const std::vector<TimedStage>& stages) {
  print_out("{:<24} {:<9} {:>9} {:>8} {:>10}  {}\n", "step", "stage", "waypoints", "time, s",
            "clear, mm", "nearest");
  for (const TimedStage& stage : stages) {
    const planning::PreflightReport& checked = stage.timed.preflight;
    print_out("{:<24} {:<9} {:>9} {:>8.2f} {:>10.2f}  {}\n", to_string(task[stage.stage.step]),
              to_string(stage.stage.kind), stage.stage.path.waypoints.size(), checked.duration,
              checked.min_clearance_mm, checked.closest_pair);
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
  planning::SceneState loaded = planning::load_scene(command.scene, plugins);
  choose_basis(command.settings, loaded);
  set_group(command.group, loaded);
  print_warnings(*loaded.scene);
  const planning::Task task = task_of(command, *loaded.scene);
  const std::unique_ptr<planning::Planner> planner =
      scene_planner(command.planner, loaded.scene->planner, plugins.planners());
  apply_settings(*planner, command.settings);
  if (!command.out.empty()) {
    make_folder(command.out);
  }
  TaskPlan plan;
  {
    std::stop_source stop;
    const StopsOnInterrupt guard(stop);
    plan = plan_task(loaded, task, *planner, command.options, stop.get_token());
  }
  const std::vector<TimedStage> stages = timed_stages(plan, command.speed);
  if (!command.out.empty()) {
    geometric::replace_file(command.out / "report.json", report_of(command, task, plan, stages));
  }
  if (!plan.solved) {
    print_error("handway: {}\n", plan.reason);
    print_trials(task, plan);
    return plan.start_is_valid ? kNoPath : kInvalidQuery;
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
  task->add_option("scene", command->scene, "Scene or problem file")->required();
  CLI::Option* file = task->add_option("--task", command->task, "Task file (YAML) with the steps");
  CLI::Option* pick = task->add_option("--pick", command->pick, "Object to grasp")->excludes(file);
  CLI::Option* on = task->add_option("--place-on", command->place_on,
                                     "Object on which the grasped object is placed, anywhere")
                        ->needs(pick);
  task->add_option("--place-at", command->place_at,
                   "Pose in the world at which it is placed instead, m and degrees")
      ->type_name("X,Y,Z,ROLL,PITCH,YAW")
      ->delimiter(',')
      ->expected(6)
      ->check(number_in(-1e3, 1e3))
      ->needs(pick)
      ->excludes(on);
  task->add_option("--then", command->then,
                   "Posture at the end: start, or one of the scene or the robot")
      ->excludes(file);
  task->add_option(
      "--planner", command->planner,
      "Planner of the motions that are not straight (default: the scene's, else auto)");
  task->add_option("--set", command->settings,
                   "Parameter of the planner, KEY=VALUE; or a hand basis, basis=FILE")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  task->add_option("--seed", command->options.seed, "Seed of all random choices")
      ->check(not_negative())
      ->capture_default_str();
  task->add_option("--threads", command->options.threads,
                   "Number of threads; the result does not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  task->add_option("--motion-time", command->options.motion_time_s,
                   "Seconds before a motion of the planner is given up")
      ->check(positive_number())
      ->capture_default_str();
  task->add_option("--grasps", command->options.grasps.most, "Grasps to try at most")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  task->add_option("--places", command->options.places, "Places to try for each grasp at most")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  task->add_option("--friction", command->options.grasps.contact.friction,
                   "Coefficient of friction between hand and object")
      ->check(CLI::Range(0.01, 10.0))
      ->capture_default_str();
  task->add_option("--payload", command->options.grasps.payload, "Mass of the object, kg")
      ->check(CLI::Range(0.0, 1e4))
      ->capture_default_str();
  task->add_option("--speed", command->speed, "Share of full speed, in (0, 1]")
      ->check(number_in(1e-3, 1.0))
      ->capture_default_str();
  add_group_option(*task, command->group);
  task->add_option("--out", command->out,
                   "Folder for the report, and the stages' scenes and paths");
  task->callback([command, &exit_code] { exit_code = plan(*command); });
}

}  // namespace handway::tools
