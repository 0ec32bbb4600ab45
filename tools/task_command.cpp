#include "commands.h"
#include "handway/execution/motion/motion_target.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/table_text.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/paths/path_file.h"
#include "handway/planning/tasks/task.h"
#include "handway/planning/tasks/timed_task.h"
#include "handway/planning/timing/time_path.h"
#include "handway/planning/timing/timing_settings.h"
#include "motion_sending.h"
#include "numbers.h"
#include "parameter_options.h"
#include "printing.h"
#include "task_request.h"
#include "terminal.h"
#include "version.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTableName = "task";  // of all stages
using Json = nlohmann::ordered_json;
using planning::TaskPlan;
using planning::TaskStage;
using planning::TimedPath;

struct TaskCommand {
  TaskRequest request;
  planning::TimingSettings timing;
  fs::path out;
  std::vector<std::string> formats;  ///< Names of exporters.
  planning::ExportOptions export_options;
  SendOptions send;
};

/// Results of the command.
struct PlannedTask {
  planning::Task task;
  TaskPlan plan;
  planning::TimedTask timed;
  std::vector<SeenFile> files;  ///< Files of the scene, as they were read.

  /// Name of the files of a stage without an ending: "01-approach".
  [[nodiscard]] std::string file_of(std::size_t stage) const {
    return fmt::format("{:02}-{}", stage + 1, to_string(plan.stages[stage].kind));
  }
  [[nodiscard]] double duration() const {
    double sum = 0.0;
    for (const TimedPath& stage : timed.stages) {
      sum += stage.preflight.duration;
    }
    return sum;
  }
};

// Rows of all stages: the stage, seconds from the begin of the task, and the joints that move.
std::string program_csv(const planning::Motion& motion) {
  std::string text = "stage,time";
  for (int v = 0; v < motion.model->variable_count(); ++v) {
    text.append(",").append(geometric::csv_cell(motion.model->variable(v).name));
  }
  text += '\n';
  for (const planning::TrajectoryPoint& point : motion.trajectory.points) {
    fmt::format_to(std::back_inserter(text), "{},{}",
                   geometric::csv_cell(stage_at(motion, point.time)->name),
                   planning::csv_time(point.time));
    for (const double value : point.position) {
      fmt::format_to(std::back_inserter(text), ",{}", value);
    }
    text += '\n';
  }
  return text;
}

Json list_of(const Eigen::VectorXd& v) { return std::vector<double>(v.begin(), v.end()); }

Json json_of(const planning::StageTrials& trials) {
  return {{"step", trials.step + 1}, {"stage", to_string(trials.kind)},
          {"tried", trials.tried},   {"failed", trials.failed},
          {"reason", trials.reason}, {"configuration", list_of(trials.q)}};
}

Json json_of(const PlannedTask& planned, std::size_t index) {
  const TaskStage& stage = planned.plan.stages[index];
  const TimedPath& timed = planned.timed.stages[index];
  const planning::PreflightReport& checked = timed.preflight;
  Json json = {{"step", stage.step + 1},
               {"stage", to_string(stage.kind)},
               {"scene", planned.file_of(index) + ".yaml"},
               {"path", planned.file_of(index) + ".csv"},
               {"carried", stage.carried},
               {"waypoints", stage.path.waypoints.size()},
               {"deviation_mm", geometric::millimetres(stage.deviation)},
               {"cleared", timed.cleared()},
               {"duration_s", checked.duration},
               {"min_clearance_mm", geometric::millimetres(checked.min_clearance)},
               {"closest_pair", checked.closest_pair}};
  if (stage.squeezed.size() > 0) {
    json["squeeze"] = list_of(stage.squeezed);
  }
  if (const auto* output = std::get_if<planning::OutputStep>(&planned.task[stage.step])) {
    json["output"] = {{"name", output->name}};
    std::visit([&](auto value) { json["output"]["value"] = value; }, output->value);
  }
  return json;
}

std::string report_of(const TaskCommand& command, const PlannedTask& planned) {
  Json steps = Json::array();
  for (const planning::TaskStep& step : planned.task) {
    steps.push_back(to_string(step));
  }
  Json stages = Json::array();
  for (std::size_t i = 0; i < planned.timed.stages.size(); ++i) {
    stages.push_back(json_of(planned, i));
  }
  Json trials = Json::array();
  for (const planning::StageTrials& one : planned.plan.trials) {
    trials.push_back(json_of(one));
  }
  const Json report = {{"solved", planned.plan.solved},
                       {"reason", planned.plan.reason},
                       {"steps", steps},
                       {"stages", stages},
                       {"trials", trials},
                       {"duration_s", planned.duration()},
                       {"seed", command.request.options.seed},
                       {"threads", command.request.options.threads},
                       {"time_s", planned.plan.time_s},
                       {"version", kVersion}};
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void print_stages(const PlannedTask& planned) {
  print_out("{:<24} {:<9} {:>9} {:>8} {:>10}  {}\n", "step", "stage", "waypoints", "time, s",
            "clear, mm", "nearest");
  for (std::size_t i = 0; i < planned.timed.stages.size(); ++i) {
    const TaskStage& stage = planned.plan.stages[i];
    const planning::PreflightReport& checked = planned.timed.stages[i].preflight;
    print_out("{:<24} {:<9} {:>9} {:>8.2f} {:>10.2f}  {}\n", to_string(planned.task[stage.step]),
              to_string(stage.kind), stage.path.waypoints.size(), checked.duration,
              geometric::millimetres(checked.min_clearance), checked.closest_pair);
  }
}

// Writes the scene and the path of each stage, and all of them as one table.
void write_stages(const fs::path& folder, const PlannedTask& planned) {
  for (std::size_t i = 0; i < planned.plan.stages.size(); ++i) {
    const TaskStage& stage = planned.plan.stages[i];
    const std::string file = planned.file_of(i);
    geometric::write_scene(*stage.state.scene, folder / (file + ".yaml"));
    planning::write_path_csv(stage.path, *planned.timed.stages[i].motion.model,
                             folder / (file + ".csv"));
  }
  geometric::replace_file(folder / fmt::format("{}.csv", kTableName),
                          program_csv(planned.timed.motion));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw geometric::OutputError(
        {folder.string(), "", error.message(), "a folder that can be made", "Choose another one"});
  }
}

// Names the stages that do not pass the pre-flight check.
void print_faults(const PlannedTask& planned, const std::string& format) {
  for (std::size_t i = 0; i < planned.timed.stages.size(); ++i) {
    const TimedPath& stage = planned.timed.stages[i];
    if (!stage.cleared()) {
      print_error("handway: the stage {} does not pass the pre-flight check{}. {}\n",
                  planned.file_of(i), format.empty() ? "" : " for " + format,
                  stage.blends.fault.empty() ? to_text(stage.preflight) : stage.blends.fault);
    }
  }
}

// Returns the name of the whole motion in programs, which is not that of the table of all stages.
std::string program_name(const fs::path& scene) {
  const std::string name = planning::motion_name(scene.stem().string());
  return name == kTableName ? name + "_program" : name;
}

planning::TimedTask time_planned(const TaskCommand& command, const PlannedTask& planned,
                                 const planning::TimingSettings& settings,
                                 const std::stop_token& stop,
                                 const planning::Configuration& measured = {}) {
  if (planned.plan.stages.empty()) {
    return {};
  }
  const geometric::Scene& scene = *planned.plan.stages.front().state.scene;
  planning::TimingOptions options = timing_options(settings, *scene.robots.front().model);
  options.stop = stop;
  options.measured_start = measured;
  options.start_tolerance = command.send.tolerances.start;
  return time_task(planned.task, planned.plan, program_name(command.request.scene), options);
}

/// Writes a task in the formats of exporters. All files are made before the first is written.
class TaskExport {
 public:
  TaskExport(const TaskCommand& command, const planning::PluginManager& plugins)
      : command_(command) {
    for (const std::string& format : command.formats) {
      exporters_.push_back(&plugins.exporter(format));
    }
  }

  /// Makes the files of all formats. @returns false if the task does not pass the pre-flight check
  /// as one of them needs it timed.
  bool make(const PlannedTask& planned, const std::stop_token& stop) {
    for (const planning::Exporter* exporter : exporters_) {
      PlannedTask timed_for = planned;
      const planning::TimingSettings settings = exporter->settings_for(command_.timing);
      if (!(settings == command_.timing)) {
        timed_for.timed = time_planned(command_, planned, settings, stop);
        if (!timed_for.timed.cleared()) {
          print_faults(timed_for, exporter->name());
          return false;
        }
      }
      add(exporter->files(timed_for.timed.motion, command_.export_options));
      for (const std::string& warning : exporter->warnings(timed_for.timed.motion)) {
        print_error("warning: {}\n", warning);
      }
    }
    return true;
  }

  void write() const {
    for (const fs::path& file : planning::write_files(files_, command_.out)) {
      print_out("{}\n", file.string());
    }
  }

 private:
  // Adds files, but not those that another format has made, too: the targets of the hand.
  void add(std::vector<planning::ExportedFile> files) {
    for (planning::ExportedFile& file : files) {
      if (std::ranges::find(files_, file.name, &planning::ExportedFile::name) == files_.end()) {
        files_.push_back(std::move(file));
      }
    }
  }

  const TaskCommand& command_;
  std::vector<const planning::Exporter*> exporters_;
  std::vector<planning::ExportedFile> files_;
};

// Runs the task on the devices. It begins only where they are measured.
int send(const TaskCommand& command, PlannedTask planned, std::stop_source& stop) {
  const planning::SceneState& begin = planned.plan.stages.front().state;
  const auto problem = planning::make_problem(begin.scene, begin.basis);
  std::vector<execution::MotionTarget> targets = execution::parse_targets(command.send.to, problem);
  execution::check_that_the_rest_stands(problem.model(), planned.timed.motion.path, targets);
  if (!connect(targets, stop.get_token())) {
    return end_before_the_start();
  }
  planned.timed =
      time_planned(command, planned, command.timing, {},
                   execution::with_measured(planned.timed.motion.path.waypoints.front(), targets));
  if (!planned.timed.cleared()) {
    print_faults(planned, "");
    return kNoPath;
  }
  print_out("{}", to_text(whole_task(planned.timed).preflight));
  if (const std::string unset = execution::unset_outputs(planned.timed.motion); !unset.empty()) {
    print_error("warning: {}\n", unset);
  }
  std::vector<planning::SceneState> scenes;
  std::ranges::transform(planned.plan.stages, std::back_inserter(scenes), &TaskStage::state);
  Sending sending{.parts = execution::parts_of(planned.timed.motion, scenes),
                  .speed = command.timing.speed,
                  .files = std::move(planned.files),
                  .on_edit = [](execution::SceneWatch& watch) {
                    watch.revoke("A file of the scene was edited: plan the task again.");
                  }};
  return send_parts(command.send, targets, std::move(sending), stop);
}

int plan(TaskCommand& command) {
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  TaskExport exported(command, plugins);
  if (!command.out.empty()) {
    make_folder(command.out);
  }
  std::stop_source stop;
  const StopsOnInterrupt guard(stop);
  auto [task, plan, files] = plan_requested(command.request, plugins, stop.get_token());
  PlannedTask planned{std::move(task), std::move(plan), {}, std::move(files)};
  planned.timed = time_planned(command, planned, command.timing, {});
  if (!command.out.empty()) {
    geometric::replace_file(command.out / "report.json", report_of(command, planned));
  }
  if (!planned.plan.solved) {
    return print_failure(planned.task, planned.plan);
  }
  print_stages(planned);
  print_out("Planned in {:.2f} s\n", planned.plan.time_s);
  if (!planned.timed.cleared()) {
    print_faults(planned, "");
    return kNoPath;
  }
  if (!exported.make(planned, {})) {
    return kNoPath;
  }
  if (!command.out.empty()) {
    write_stages(command.out, planned);
    exported.write();
  }
  return command.send.to.empty() ? kDone : send(command, std::move(planned), stop);
}

void add_export_options(CLI::App& task, TaskCommand& command) {
  CLI::Option* out = task.add_option(
      "--out", command.out, "Folder for the report, the stages' scenes and paths, and programs");
  CLI::Option* formats =
      task.add_option("--export", command.formats,
                      "Formats in which the whole task is written as one motion, as for export")
          ->delimiter(',')
          ->type_name("FORMAT,...")
          ->needs(out);
  task.add_option("--gripper-output", command.export_options.gripper_output,
                  "Digital output that closes the hand, in programs for an arm")
      ->check(CLI::NonNegativeNumber)
      ->needs(formats);
  task.add_option("--gripper-time", command.export_options.gripper_time,
                  "Least wait after the output is set, s")
      ->check(number_in(0.0, 60.0))
      ->capture_default_str()
      ->needs(formats);
  task.add_flag("--any-robot", command.export_options.any_robot,
                "Export even if a format does not seem to suit this robot")
      ->needs(formats);
}

// A task that is sent runs at a cautious speed if the user chooses none.
void choose_cautious_timing(const CLI::App& task, planning::TimingSettings& timing) {
  if (task.get_option("--speed")->empty()) {
    timing.speed = kCautiousSpeed;
  }
  if (task.get_option("--period-ms")->empty()) {
    timing.period = kPointPeriod;
  }
}

}  // namespace

void add_task_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<TaskCommand>();
  CLI::App* task = app.add_subcommand("task", "Plan a task: pick an object, carry it and place it");
  add_task_request(*task, command->request);
  add_parameter_options(*task, parameters_of(command->timing));
  task->get_option("--no-blend")->excludes(task->get_option("--deviation"));
  add_export_options(*task, *command);
  add_send_options(*task, command->send)->excludes(task->get_option("--export"));
  task->callback([task, command, &exit_code] {
    if (!command->send.to.empty()) {
      choose_cautious_timing(*task, command->timing);
    }
    exit_code = plan(*command);
  });
}

}  // namespace handway::tools
