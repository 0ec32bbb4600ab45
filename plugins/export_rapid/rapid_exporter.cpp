#include "rapid_exporter.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/extensions/arm_program.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/extensions/program_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <memory>
#include <string_view>
#include <variant>

namespace handway::export_rapid {
namespace {

using planning::fixed_decimals;

constexpr std::size_t kLongestName = 28;  // "run_" comes before it
constexpr std::size_t kLongestSignal = 32;
constexpr double kStartTolerance = 0.1;  // deg

// Reserved words (RAPID overview, lexical elements), data types, and names that the module uses.
constexpr auto kKeywords = std::to_array<std::string_view>(
    {"alias",     "and",      "backward", "bookmark",  "bool",    "case",        "clock",
     "connect",   "const",    "default",  "div",       "do",      "else",        "elseif",
     "endfor",    "endfunc",  "endif",    "endmodule", "endproc", "endrecord",   "endtest",
     "endtrap",   "endwhile", "error",    "exit",      "false",   "for",         "from",
     "func",      "goto",     "here",     "if",        "inout",   "jointtarget", "local",
     "mod",       "module",   "nostepin", "not",       "noview",  "num",         "or",
     "pers",      "proc",     "raise",    "readonly",  "record",  "retry",       "return",
     "robtarget", "step",     "string",   "sysmodule", "test",    "then",        "to",
     "tooldata",  "trap",     "true",     "trynext",   "undo",    "var",         "viewonly",
     "while",     "with",     "xor"});

constexpr const char* kAbb = "(^|[^a-z0-9])(abb($|[^a-z])|(irb|crb)[-_ ]?[0-9]{3,5})";

/// Name of the point of a waypoint.
std::string point_name(std::size_t waypoint) { return fmt::format("p{}", waypoint); }

std::string declaration(std::size_t waypoint, const Eigen::VectorXd& arm) {
  std::vector<std::string> angles;
  std::ranges::transform(arm, std::back_inserter(angles),
                         [](double angle) { return fixed_decimals(geometric::degrees(angle), 6); });
  return fmt::format("  LOCAL CONST jointtarget {}:=[[{}],[9E9,9E9,9E9,9E9,9E9,9E9]];\n",
                     point_name(waypoint), fmt::join(angles, ","));
}

std::string comment(const std::string& indent, const std::string& text) {
  return indent + "! " + text + "\n";
}

// Returns the name of the signal of an output; empty if its name is none. A number N is the signal
// doN, or aoN of an analog output.
std::string signal_name(const geometric::OutputStep& output) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::string name = output.name;
  if (std::ranges::all_of(name, is_digit)) {
    name.insert(0, std::holds_alternative<bool>(output.value) ? "do" : "ao");
  }
  std::string lower = name;
  std::ranges::transform(lower, lower.begin(),
                         [&](char c) { return is_letter(c) ? static_cast<char>(c | 0x20) : c; });
  const bool is_name =
      name.size() <= kLongestSignal && is_letter(name.front()) &&
      std::ranges::all_of(name, [&](char c) { return is_letter(c) || is_digit(c) || c == '_'; }) &&
      std::ranges::find(kKeywords, lower) == kKeywords.end();
  return is_name ? name : std::string();
}

std::string text_of(const planning::ArmOutput& set) {
  const geometric::OutputStep& output = set.output;
  const std::string name = signal_name(output);
  if (name.empty()) {
    return comment("    ", planning::unset_output_comment(output));
  }
  if (const bool* on = std::get_if<bool>(&output.value)) {
    return fmt::format("    SetDO {},{};\n", name, *on ? 1 : 0);
  }
  return fmt::format("    SetAO {},{};\n", name, fixed_decimals(std::get<double>(output.value), 6));
}

std::string text_of(const planning::ArmInstruction& instruction) {
  if (const auto* move = std::get_if<planning::ArmMove>(&instruction)) {
    return fmt::format("    MoveAbsJ {}\\NoEOffs,v1000\\T:={},fine,tool0;\n",
                       point_name(move->point),
                       planning::duration_decimals(move->move.duration, 4));
  }
  if (const auto* wait = std::get_if<planning::ArmWait>(&instruction)) {
    return fmt::format("    WaitTime {};\n", planning::duration_decimals(wait->duration, 3));
  }
  if (const auto* output = std::get_if<planning::GripperOutput>(&instruction)) {
    return fmt::format("    SetDO do{},{};\n", output->number, output->closes ? 1 : 0);
  }
  if (const auto* output = std::get_if<planning::ArmOutput>(&instruction)) {
    return text_of(*output);
  }
  return comment("    ", std::get<planning::ArmComment>(instruction).text);
}

/// Writes the check that ends the program unless the arm is at the first point.
std::string start_check() {
  std::vector<std::string> joints;
  for (int j = 1; j <= 6; ++j) {
    joints.push_back(
        fmt::format("Abs(here.robax.rax_{0}-p0.robax.rax_{0})>{1}", j, kStartTolerance));
  }
  return fmt::format(R"(    here:=CJointT();
    IF {} THEN
      TPWrite "The arm is not where the motion begins.";
      EXIT;
    ENDIF
)",
                     fmt::join(joints, " OR\n       "));
}

void check_output(const planning::ExportOptions& options) {
  if (const int output = options.gripper_output.value_or(0); output < 0) {
    throw geometric::InputError(
        {"gripper output", "", std::to_string(output), "0 or more for RAPID, the signal doN", ""});
  }
}

}  // namespace

std::string RapidExporter::robot_objection(const planning::Motion& motion) const {
  return is_robot_named(motion, kAbb) ? std::string()
                                      : "an arm of ABB: RAPID runs on its controller alone";
}

std::string RapidExporter::output_objection(const geometric::OutputStep& output) const {
  return signal_name(output).empty()
             ? fmt::format(
                   "RAPID sets signals by their names, of up to {} letters, digits and "
                   "\"_\", the first a letter",
                   kLongestSignal)
             : std::string();
}

std::vector<planning::ExportedFile> RapidExporter::do_export(
    const planning::Motion& motion, const planning::ExportOptions& options) const {
  require_arm(motion, {.language = "RAPID"});
  check_output(options);
  const std::vector<planning::ArmInstruction> instructions = arm_instructions(motion, options);
  const std::string name = planning::program_name(motion.name, kLongestName, kKeywords);
  std::string text = fmt::format("MODULE {}\n", name);
  for (const std::string& remark : program_heading(motion)) {
    text += comment("  ", remark);
  }
  text += declaration(0, motion.path.waypoints.front()(motion.arm));
  for (const planning::ArmInstruction& instruction : instructions) {
    if (const auto* move = std::get_if<planning::ArmMove>(&instruction)) {
      text += declaration(move->point, move->move.target);
    }
  }
  text += fmt::format("\n  PROC run_{}()\n    VAR jointtarget here;\n", name) + start_check();
  for (const planning::ArmInstruction& instruction : instructions) {
    text += text_of(instruction);
  }
  text += "  ENDPROC\nENDMODULE\n";
  std::vector<planning::ExportedFile> files = {{name + ".mod", text}};
  std::ranges::move(hand_target_files(motion, options), std::back_inserter(files));
  return files;
}

}  // namespace handway::export_rapid

HANDWAY_PLUGIN({.name = "export_rapid", .version = HANDWAY_VERSION, .make_exporters = [] {
                  std::vector<std::unique_ptr<handway::planning::Exporter>> exporters;
                  exporters.push_back(std::make_unique<handway::export_rapid::RapidExporter>());
                  return exporters;
                }});
