#include "commands.h"
#include "emulated_device.h"
#include "handway/device/core/trajectory_client.h"
#include "handway/device/emulators/haptic_emulator.h"
#include "handway/device/haptic/haptic_device.h"
#include "handway/device/ros/ros_robot.h"
#include "handway/execution/guidance/guidance_run.h"
#include "handway/execution/motion/motion_target.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/table_text.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/planning/paths/path_check.h"
#include "handway/planning/timing/kinematic_limits.h"
#include "parameter_options.h"
#include "printing.h"
#include "scene_file_watch.h"
#include "terminal.h"
#include "timing_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace handway::tools {
namespace {

/// A guidance as CSV, a row for each sample of the device: `time` (s), `progress` (m of the tool's
/// path), `place` (a waypoint's index with the share of the motion to the next), `button`,
/// `deviation` (m of the hand), `force.x`, `force.y`, `force.z` (N, in the device's frame), then
/// the commanded joints of the robot (rad). Rows are written as they come.
class HapticLog {
 public:
  /// @param file empty: nothing is written. @throws OutputError if it can't be written.
  HapticLog(const std::filesystem::path& file, const geometric::RobotModel& model);

  void add(const execution::GuidanceSample& sample);
  /// False if a row could not be written.
  [[nodiscard]] bool good() const { return !out_.is_open() || out_.good(); }

 private:
  std::ofstream out_;
};

HapticLog::HapticLog(const std::filesystem::path& file, const geometric::RobotModel& model) {
  if (file.empty()) {
    return;
  }
  out_.open(file, std::ios::binary | std::ios::trunc);
  std::string header = "time,progress,place,button,deviation,force.x,force.y,force.z";
  for (int v = 0; v < model.variable_count(); ++v) {
    header += "," + geometric::csv_cell(model.variable(v).name);
  }
  out_ << header << '\n' << std::flush;
  if (!out_) {
    throw geometric::OutputError(
        {file.string(), "", std::strerror(errno), "a file to write to", ""});
  }
}

void HapticLog::add(const execution::GuidanceSample& sample) {
  if (!out_.is_open()) {
    return;
  }
  const Eigen::Vector3d& force = sample.step.force;
  std::string row = fmt::format("{:.6f},{:.6f},{:.6f},{},{:.6f},{:.4f},{:.4f},{:.4f}", sample.time,
                                sample.step.progress, sample.place, sample.handle.button ? 1 : 0,
                                sample.step.deviation, force.x(), force.y(), force.z());
  for (const double q : sample.q) {
    row += fmt::format(",{:.6f}", q);
  }
  out_ << row + "\n";
}

constexpr double kCautiousSpeed = 0.1;
constexpr double kProgressPeriod = 0.5;    // s
constexpr double kLeadTime = 0.1;          // s
constexpr double kMillimetre = 1e-3;       // m
constexpr double kCheckResolution = 1e-3;  // m

struct GuideChoice {
  TimingChoice timing;
  std::string to;
  std::string robot;
  std::string link;
  std::filesystem::path log;
  device::ForceGuideSettings guide;
  device::MotionTolerances tolerances;
  bool yes = false;
};

/// Robots in ROS that follow the guidance.
class LedRobots {
 public:
  LedRobots(const std::string& text, const planning::PlanningProblem& problem)
      : targets_(text.empty() ? std::vector<execution::MotionTarget>()
                              : execution::parse_targets(text, problem)) {
    for (const execution::MotionTarget& target : targets_) {
      auto* robot = dynamic_cast<device::RosRobot*>(target.link.get());
      if (robot == nullptr) {
        throw geometric::InputError({"--robot", "", target.link->name(), "ros:// or ros2://",
                                     "Other devices accept whole motions only."});
      }
      robots_.push_back(robot);
    }
  }

  // @throws InputError if a joint is far from the path's beginning.
  void connect(const planning::Configuration& start, double tolerance,
               const std::stop_token& stop) {
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      robots_[i]->connect(stop);
      for (std::size_t j = 0; j < targets_[i].variables.size(); ++j) {
        const double wanted = start[targets_[i].variables[j]];
        const double found = robots_[i]->measured().position[static_cast<Eigen::Index>(j)];
        if (std::abs(found - wanted) > tolerance) {
          throw geometric::InputError(
              {targets_[i].link->name(), "joint " + robots_[i]->joints().names[j],
               fmt::format("{:.4f} rad", found),
               fmt::format("{:.4f} rad within {:g}, the path's start", wanted, tolerance),
               "Move the robot to the start, or plan from its present configuration."});
        }
      }
    }
  }

  void lead(const planning::Configuration& q) {
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      Eigen::VectorXd part(robots_[i]->joints().count());
      for (std::size_t j = 0; j < targets_[i].variables.size(); ++j) {
        part[static_cast<Eigen::Index>(j)] = q[targets_[i].variables[j]];
      }
      robots_[i]->update();
      robots_[i]->lead(part, kLeadTime);
    }
  }

  [[nodiscard]] bool empty() const { return robots_.empty(); }
  [[nodiscard]] const std::vector<execution::MotionTarget>& targets() const { return targets_; }

 private:
  std::vector<execution::MotionTarget> targets_;
  std::vector<device::RosRobot*> robots_;
};

// Returns the fault of the path; empty if the robot may follow it.
std::string fault_of(planning::PlanningProblem problem, const planning::Path& path) {
  problem.start = path.waypoints.front();
  problem.goal = path.waypoints.back();
  const planning::PathCheckResult result = check_path(problem, path, kCheckResolution);
  return result.valid() ? "" : result.faults.front();
}

void check_path_is_free(const TimingInput& input) {
  if (const std::string fault = fault_of(input.problem, input.path); !fault.empty()) {
    throw geometric::InputError(
        {"path", "", fault, "a path that is valid in this scene", "Plan again."});
  }
}

int report(const execution::GuidanceOutcome& outcome, const device::ForceGuide& guide,
           const HapticLog& log) {
  print_out(
      "{} samples in {:.1f} s, {} grips, largest deviation of the hand {:.1f} mm, largest force "
      "{:.2f} N\n",
      outcome.samples, outcome.time, guide.grips(), outcome.largest_deviation / kMillimetre,
      outcome.strongest);
  if (!log.good()) {
    print_error("The log could not be written to its end.\n");
  }
  if (outcome.arrived) {
    print_out("done: the path's end is reached\n");
    return log.good() ? kDone : kNotWritten;
  }
  std::fflush(stdout);
  if (!outcome.fault.empty()) {
    print_error("{}\n", outcome.fault);
  }
  print_out("STOPPED {}: no force is applied, the robot is at rest\n",
            outcome.fault.empty() ? "on request" : "after a fault");
  return kMotionStopped;
}

int guide(const GuideChoice& choice) {
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  const geometric::FilesRead notes;
  const TimingInput input = read_timing_input(choice.timing, plugins);
  const geometric::RobotModel& model = input.problem.model();
  const execution::PathToolCurve tool_path(
      input.problem.scene->robots.front().model, input.path,
      choice.link.empty() ? execution::tool_link(model, input.problem.joints.arm) : choice.link);
  const planning::JointKinematicLimits limits =
      choice.timing.limits.empty()
          ? planning::rate_limits(model)
          : planning::read_joint_kinematic_limits(model, choice.timing.limits);
  std::vector<planning::AssumedLimit> assumed = limits.assumed;
  std::erase_if(assumed, [](const auto& one) { return one.rate != planning::Rate::kVelocity; });
  for (const std::string& line : assumption_lines(assumed)) {
    print_out("{}\n", line);
  }
  check_path_is_free(input);
  device::ForceGuideSettings settings = choice.guide;
  const std::unique_ptr<device::HapticDevice> handle = device::make_haptic_device(choice.to);
  LedRobots robots(choice.robot, input.problem);
  if (!robots.empty()) {
    execution::check_that_the_rest_stands(model, input.path, robots.targets());
  }
  std::stop_source stop;
  const StopsOnInterrupt guard(stop);
  robots.connect(input.path.waypoints.front(), choice.tolerances.start, stop.get_token());
  handle->connect(stop.get_token());
  print_out(
      "{}: path of the tool {:.2f} m, of the operator's hand {:.2f} m; forces up to {:.2f} N\n",
      handle->name(), tool_path.curve()->length(), tool_path.curve()->length() / settings.scale,
      std::min(settings.strongest, handle->abilities().force));
  if (!robots.empty() && !choice.yes) {
    print_error("Nothing moved. Add --yes to let the robot move.\n");
    return kWrongUsage;
  }
  std::fflush(stdout);
  HapticLog log(choice.log, model);
  std::atomic<bool> edited = false;
  const SceneFileWatch edits(see_files(notes.files()), [&edited] { edited = true; });
  if (!robots.empty()) {
    // Its files may have been edited while devices were connected.
    planning::Path route = input.path;
    route.waypoints.insert(route.waypoints.begin(),
                           execution::with_measured(route.waypoints.front(), robots.targets()));
    const std::string fault = fault_of(read_problem_again(choice.timing, plugins, model), route);
    if (!fault.empty()) {
      print_error("Nothing moved: {}\n", fault);
      return kNoPath;
    }
  }
  device::ForceGuide force_guide(tool_path.curve(), settings);
  execution::GuidedMotion motion(input.path,
                                 limits.at_speed(choice.timing.settings.speed).velocity);
  double next = kProgressPeriod;
  const execution::GuidanceOutcome outcome = run_guidance(
      *handle, force_guide, tool_path, motion, stop.get_token(),
      {.on_sample =
           [&](const execution::GuidanceSample& sample) {
             log.add(sample);
             if (sample.time >= next) {
               next += kProgressPeriod;
               print_out("{:.1f} s: {:.3f} of {:.3f} m, deviation {:.1f} mm, {:.2f} N\n",
                         sample.time, sample.step.progress, tool_path.curve()->length(),
                         sample.step.deviation / kMillimetre, sample.step.force.norm());
               std::fflush(stdout);
             }
           },
       .lead =
           [&](const planning::Configuration& q) {
             if (edited && !robots.empty()) {
               throw std::runtime_error(
                   "The scene was edited, and the remaining path is not checked. Start again.");
             }
             robots.lead(q);
           }});
  return report(outcome, force_guide, log);
}

/// Adds `handway haptic guide`.
void add_haptic_guide(CLI::App& haptic, int& exit_code) {
  auto choice = std::make_shared<GuideChoice>();
  choice->timing.settings.speed = kCautiousSpeed;
  CLI::App* command =
      haptic.add_subcommand("guide", "Guide the operator's hand along a path; the robot follows");
  command->add_option("path", choice->timing.path, "Path (CSV)")->required();
  command->add_option("--scene", choice->timing.scene, "Scene or problem file of the path")
      ->required();
  command->add_option("--to", choice->to, "Haptic device: haptic://HOST[:PORT]")->required();
  command->add_option(
      "--robot", choice->robot,
      "Robot that follows: ros://HOST[:PORT][/CONTROLLER][#arm|#hand] (ros2:// for ROS 2)");
  command->add_flag("--yes", choice->yes, "Let the robot move");
  command->add_option("--link", choice->link,
                      "Link that the handle represents (default: the arm's last)");
  command->add_option("--log", choice->log, "File for the log (CSV)");
  command->add_option("--limits", choice->timing.limits, "Velocity limits (joint_limits.yaml)");
  add_parameter_options(*command,
                        {find_parameter(parameters_of(choice->timing.settings), "speed"),
                         find_parameter(parameters_of(choice->tolerances), "start_tolerance")});
  add_parameter_options(*command, parameters_of(choice->guide));
  command->callback([choice, &exit_code] { exit_code = guide(*choice); });
}

struct EmulateChoice {
  EmulatedDeviceChoice device;
  double tremble = device::EmulatedHapticSettings{}.tremble;
};

int emulate(const EmulateChoice& choice) {
  device::EmulatedHapticSettings settings;
  settings.tremble = choice.tremble;
  settings.fault = chosen_fault(choice.device);
  const device::HapticEmulator emulator(settings, choice.device.port);
  return serve_device(emulator.address(), choice.device);
}

}  // namespace

void add_haptic_command(CLI::App& app, int& exit_code) {
  CLI::App* haptic =
      app.add_subcommand("haptic", "Follow a path with a haptic device, or emulate one");
  haptic->require_subcommand(1);
  add_haptic_guide(*haptic, exit_code);
  auto choice = std::make_shared<EmulateChoice>();
  choice->device.port = device::kHapticPort;
  CLI::App* command = haptic->add_subcommand(
      "emulate",
      "Emulate a haptic device with a compliant hand; the first line of output is its address");
  add_emulator_options(*command, choice->device, {"none", "late", "lost", "refused", "estop"});
  command->add_option("--tremble", choice->tremble, "Force of the hand's tremor, N")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command->callback([choice, &exit_code] { exit_code = emulate(*choice); });
}

}  // namespace handway::tools
