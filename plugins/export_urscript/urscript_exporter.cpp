#include "urscript_exporter.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/extensions/arm_program.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/extensions/program_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <string_view>
#include <variant>

namespace handway::export_urscript {
namespace {

using planning::fixed_decimals;

constexpr std::size_t kLongestName = 100;
constexpr double kStartTolerance = geometric::radians(0.1);  // rad
constexpr double kLargestAngle = geometric::radians(363.0);  // rad, where the controller stops
constexpr int kMostOutput = 7;
constexpr double kLookahead = 0.03;  // s, the least of servoj
constexpr int kGain = 300;           // of servoj, its default
constexpr double kBrake = 2.0;       // rad/s², of stopj at rest

// Words of the language, and functions and variables that the program uses.
constexpr auto kKeywords = std::to_array<std::string_view>({"and",
                                                            "break",
                                                            "continue",
                                                            "def",
                                                            "elif",
                                                            "else",
                                                            "end",
                                                            "enter_critical",
                                                            "exit_critical",
                                                            "false",
                                                            "for",
                                                            "global",
                                                            "goto",
                                                            "halt",
                                                            "here",
                                                            "i",
                                                            "if",
                                                            "in",
                                                            "join",
                                                            "kill",
                                                            "local",
                                                            "loop",
                                                            "mod",
                                                            "movej",
                                                            "norm",
                                                            "not",
                                                            "or",
                                                            "pass",
                                                            "popup",
                                                            "return",
                                                            "run",
                                                            "sec",
                                                            "servoj",
                                                            "sleep",
                                                            "start",
                                                            "stopj",
                                                            "struct",
                                                            "sync",
                                                            "thread",
                                                            "true",
                                                            "while",
                                                            "xor"});

// A robot called UR with a payload's number, or the maker's name.
constexpr const char* kUniversalRobots =
    "universal[-_ ]?robots?|(^|[^a-z0-9])ur[-_ ]?(3|5|7|8|10|12|15|16|18|20|30)(e|l)?($|[^a-z0-9])";

std::string objection(const planning::Motion& motion) {
  return is_robot_named(motion, kUniversalRobots)
             ? std::string()
             : "an arm of Universal Robots: URScript runs on its controller alone";
}

void check(const planning::Motion& motion, const planning::ExportOptions& options) {
  require_arm(motion, {.language = "URScript",
                       .advice = "Controllers of Universal Robots move arms of six joints"});
  for (const geometric::Configuration& q : motion.path.waypoints) {
    for (const int v : motion.arm) {
      if (std::abs(q[v]) > kLargestAngle) {
        throw geometric::InputError({"the motion", "joint " + motion.model->variable(v).name,
                                     fmt::format("{:.1f}°", geometric::degrees(q[v])),
                                     "angles from -363° to 363°, as the controller allows", ""});
      }
    }
  }
  if (const int output = options.gripper_output.value_or(0); output < 0 || output > kMostOutput) {
    throw geometric::InputError({"gripper output", "", std::to_string(output),
                                 "0 to 7 for URScript, a standard digital output", ""});
  }
}

std::string list(const Eigen::VectorXd& values) {
  std::vector<std::string> numbers;
  std::ranges::transform(values, std::back_inserter(numbers),
                         [](double value) { return fixed_decimals(value, 9); });
  return fmt::format("[{}]", fmt::join(numbers, ", "));
}

std::string movej(const planning::JointMove& move, double speed) {
  const double acceleration = speed * speed;
  const double velocity = std::min(move.velocity_share(acceleration), speed);
  return fmt::format(
      "  movej({}, a={}, v={}, t={})\n", list(move.target),
      fixed_decimals(acceleration * move.acceleration_limit * move.largest_change, 6),
      fixed_decimals(velocity * move.velocity_limit * move.largest_change, 6),
      planning::duration_decimals(move.duration, 6));
}

std::string servoj(const Eigen::VectorXd& q) {
  return fmt::format("  servoj({}, 0, 0, t=0.008, lookahead_time={:g}, gain={})\n", list(q),
                     kLookahead, kGain);
}

std::string rest(double duration) {
  return fmt::format("  sleep({})\n", planning::duration_decimals(duration, 6));
}

std::string text_of(const planning::ArmComment& comment) { return "  # " + comment.text + "\n"; }

std::string text_of(const planning::GripperOutput& output) {
  return fmt::format("  set_standard_digital_out({}, {})\n", output.number,
                     output.closes ? "True" : "False");
}

/// A kind of outputs of the controller: the function that sets one, and its last number.
struct OutputKind {
  std::string_view name;
  std::string_view function;
  int most = 0;
};

OutputKind kind_of(const geometric::OutputStep& output) {
  std::string lower = output.name;
  std::ranges::transform(lower, lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  if (std::holds_alternative<double>(output.value)) {
    return {"analog outputs", "set_standard_analog_out", 1};
  }
  if (lower.find("tool") != std::string::npos) {
    return {"outputs of the tool", "set_tool_digital_out", 1};
  }
  if (lower.find("conf") != std::string::npos) {
    return {"configurable outputs", "set_configurable_digital_out", kMostOutput};
  }
  return {"outputs", "set_standard_digital_out", kMostOutput};
}

std::string objection(const geometric::OutputStep& output) {
  const OutputKind kind = kind_of(output);
  if (planning::output_number(output.name).value_or(kind.most + 1) > kind.most) {
    return fmt::format("URScript sets {} by their number, 0 to {} at the end of the name",
                       kind.name, kind.most);
  }
  const double* level = std::get_if<double>(&output.value);
  if (level && !(*level >= 0.0 && *level <= 1.0)) {
    return "analog outputs of URScript are from 0 to 1";
  }
  return {};
}

std::string text_of(const planning::ArmOutput& set) {
  const geometric::OutputStep& output = set.output;
  if (!objection(output).empty()) {
    return text_of(planning::ArmComment{planning::unset_output_comment(output)});
  }
  const bool* on = std::get_if<bool>(&output.value);
  return fmt::format(
      "  {}({}, {})\n", kind_of(output).function, *planning::output_number(output.name),
      on ? (*on ? "True" : "False") : fixed_decimals(std::get<double>(output.value), 6));
}

/// Writes the beginning of the function: it ends the program unless the arm is at the first point.
std::string beginning(const planning::Motion& motion, const std::string& name,
                      const std::vector<std::string>& remarks) {
  std::string text = fmt::format("def {}():\n", name);
  for (const std::string& remark : remarks) {
    text += "  # " + remark + "\n";
  }
  return text + fmt::format(R"(  start = {}
  here = get_actual_joint_positions()
  i = 0
  while i < 6:
    if norm(here[i] - start[i]) > {}:
      popup("The arm is not where the motion begins.", title="{}", error=True, blocking=True)
      halt
    end
    i = i + 1
  end
)",
                            list(motion.path.waypoints.front()(motion.arm)),
                            fixed_decimals(kStartTolerance, 6), name);
}

std::string name_of(const planning::Motion& motion) {
  return planning::program_name(motion.name, kLongestName, kKeywords);
}

/// Returns the file of a program, and the hand's targets.
std::vector<planning::ExportedFile> files_of(const std::string& name, std::string text,
                                             const planning::Motion& motion,
                                             const planning::ExportOptions& options) {
  std::vector<planning::ExportedFile> files = {{name + ".script", std::move(text)}};
  std::ranges::move(hand_target_files(motion, options), std::back_inserter(files));
  return files;
}

/// Writes the points of a trajectory up to waypoint after waypoint.
class PointStream {
 public:
  explicit PointStream(const planning::Motion& motion) : motion_(motion) {}

  /// Passes the points to the next waypoint, at which the robot rests.
  void skip_to_next_waypoint() { static_cast<void>(to_next_waypoint()); }

  std::string to_next_waypoint() {
    constexpr double kRounding = 1e-9;  // s
    const double end = motion_.waypoint_times[++waypoint_] + kRounding;
    const bool is_last = waypoint_ + 1 == motion_.waypoint_times.size();
    const auto& points = motion_.trajectory.points;
    std::string text;
    for (; next_ < points.size() && (is_last || points[next_].time <= end); ++next_) {
      text += servoj(points[next_].position(motion_.arm));
    }
    return text;
  }

 private:
  const planning::Motion& motion_;
  std::size_t waypoint_ = 0;
  std::size_t next_ = 1;  ///< The first point is where the arm is.
};

}  // namespace

std::string UrScriptExporter::robot_objection(const planning::Motion& motion) const {
  return objection(motion);
}

std::string UrScriptExporter::output_objection(const geometric::OutputStep& output) const {
  return objection(output);
}

std::vector<planning::ExportedFile> UrScriptExporter::do_export(
    const planning::Motion& motion, const planning::ExportOptions& options) const {
  check(motion, options);
  std::vector<std::string> remarks = program_heading(motion);
  remarks.emplace_back("Each movej takes t seconds and stops at its end.");
  const std::string name = name_of(motion);
  std::string text = beginning(motion, name, remarks);
  for (const planning::ArmInstruction& instruction : arm_instructions(motion, options)) {
    if (const auto* move = std::get_if<planning::ArmMove>(&instruction)) {
      text += movej(move->move, motion.speed);
    } else if (const auto* wait = std::get_if<planning::ArmWait>(&instruction)) {
      text += rest(wait->duration);
    } else if (const auto* output = std::get_if<planning::GripperOutput>(&instruction)) {
      text += text_of(*output);
    } else if (const auto* set = std::get_if<planning::ArmOutput>(&instruction)) {
      text += text_of(*set);
    } else {
      text += text_of(std::get<planning::ArmComment>(instruction));
    }
  }
  return files_of(name, text + "end\n", motion, options);
}

std::string UrScriptServoExporter::robot_objection(const planning::Motion& motion) const {
  return objection(motion);
}

std::string UrScriptServoExporter::output_objection(const geometric::OutputStep& output) const {
  return objection(output);
}

std::vector<planning::ExportedFile> UrScriptServoExporter::do_export(
    const planning::Motion& timed, const planning::ExportOptions& options) const {
  check(timed, options);
  planning::Motion motion = timed;  // its other timing needs other names of files
  motion.name += "_servo";
  std::vector<std::string> remarks = program_heading(motion);
  remarks.emplace_back("A point every 8 ms.");
  const std::string name = name_of(motion);
  std::string text = beginning(motion, name, remarks);
  PointStream points(motion);
  for (const planning::ArmInstruction& instruction : arm_instructions(motion, options)) {
    const auto* wait = std::get_if<planning::ArmWait>(&instruction);
    if (wait && wait->rests) {
      points.skip_to_next_waypoint();
      text += fmt::format("  stopj({:.1f})\n", kBrake) + rest(wait->duration);
    } else if (std::holds_alternative<planning::ArmMove>(instruction) ||
               (wait && wait->is_waypoint)) {
      text += points.to_next_waypoint();
    } else if (wait) {
      text += fmt::format("  stopj({:.1f})\n", kBrake) + rest(wait->duration);
    } else if (const auto* output = std::get_if<planning::GripperOutput>(&instruction)) {
      text += text_of(*output);
    } else if (const auto* set = std::get_if<planning::ArmOutput>(&instruction)) {
      text += text_of(*set);
    } else {
      text += text_of(std::get<planning::ArmComment>(instruction));
    }
  }
  return files_of(name, text + fmt::format("  stopj({:.1f})\nend\n", kBrake), motion, options);
}

}  // namespace handway::export_urscript

HANDWAY_PLUGIN({.name = "export_urscript", .version = HANDWAY_VERSION, .make_exporters = [] {
                  std::vector<std::unique_ptr<handway::planning::Exporter>> exporters;
                  exporters.push_back(
                      std::make_unique<handway::export_urscript::UrScriptExporter>());
                  exporters.push_back(
                      std::make_unique<handway::export_urscript::UrScriptServoExporter>());
                  return exporters;
                }});
