#include "krl_exporter.h"

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

namespace handway::export_krl {
namespace {

using planning::fixed_decimals;

constexpr std::size_t kLongestName = 24;
constexpr int kMostOutput = 4096;
constexpr int kMostAnalogOutput = 32;
constexpr double kStartTolerance = 0.1;  // deg
constexpr double kRounding = 1e-6;       // s, of a move's duration

// Words of the language, and names that the program uses.
constexpr auto kKeywords = std::to_array<std::string_view>(
    {"and",    "anin",    "anout",    "axis",     "bas",    "bool",    "case",      "char",
     "circ",   "confirm", "const",    "continue", "decl",   "def",     "default",   "defdat",
     "deffct", "delay",   "digin",    "distance", "do",     "e6axis",  "e6pos",     "else",
     "end",    "enddat",  "endfct",   "endfor",   "endif",  "endloop", "endswitch", "endwhile",
     "enum",   "exit",    "ext",      "extfct",   "false",  "for",     "frame",     "global",
     "goto",   "halt",    "hw_rates", "if",       "import", "int",     "interrupt", "is",
     "lin",    "loop",    "maximum",  "minimum",  "not",    "or",      "pos",       "prio",
     "ptp",    "public",  "pulse",    "real",     "repeat", "resume",  "return",    "sec",
     "signal", "spline",  "step",     "struc",    "switch", "then",    "to",        "trigger",
     "true",   "until",   "wait",     "when",     "while"});

constexpr const char* kKuka = "kuka|(^|[^a-z0-9])kr[-_ ]?[0-9]{1,4}($|[^0-9])";

/// Name of the point of a waypoint.
std::string point_name(std::size_t waypoint) { return fmt::format("XP{}", waypoint); }

std::string declaration(std::size_t waypoint, const Eigen::VectorXd& arm) {
  std::vector<std::string> angles;
  for (Eigen::Index j = 0; j < arm.size(); ++j) {
    angles.push_back(fmt::format("A{} {}", j + 1, fixed_decimals(geometric::degrees(arm[j]), 6)));
  }
  return fmt::format("  DECL AXIS {}={{{}}}\n", point_name(waypoint), fmt::join(angles, ","));
}

std::string rest(double duration) {
  return fmt::format("  WAIT SEC {}\n", planning::duration_decimals(duration, 3));
}

std::string ptp(const planning::ArmMove& move, double speed) {
  const AxisRates rates = axis_rates(move.move, speed);
  return fmt::format("  HW_RATES({},{})\n  PTP {}\n", rates.velocity, rates.acceleration,
                     point_name(move.point)) +
         (rates.pause > 0.0 ? rest(rates.pause) : std::string());
}

std::string objection(const geometric::OutputStep& output) {
  const bool is_digital = std::holds_alternative<bool>(output.value);
  const int most = is_digital ? kMostOutput : kMostAnalogOutput;
  if (const int number = planning::output_number(output.name).value_or(0);
      number < 1 || number > most) {
    return fmt::format("KRL sets {} by their number, 1 to {} at the end of the name",
                       is_digital ? "outputs" : "analog outputs", most);
  }
  if (!is_digital && !(std::abs(std::get<double>(output.value)) <= 1.0)) {
    return "analog outputs of KRL are from -1 to 1";
  }
  return {};
}

std::string text_of(const planning::ArmOutput& set) {
  const geometric::OutputStep& output = set.output;
  if (!objection(output).empty()) {
    return fmt::format("  ; {}\n", planning::unset_output_comment(output));
  }
  const int number = *planning::output_number(output.name);
  if (const bool* on = std::get_if<bool>(&output.value)) {
    return fmt::format("  $OUT[{}]={}\n", number, *on ? "TRUE" : "FALSE");
  }
  return fmt::format("  $ANOUT[{}]={}\n", number,
                     fixed_decimals(std::get<double>(output.value), 6));
}

std::string text_of(const planning::ArmInstruction& instruction, double speed) {
  if (const auto* move = std::get_if<planning::ArmMove>(&instruction)) {
    return ptp(*move, speed);
  }
  if (const auto* wait = std::get_if<planning::ArmWait>(&instruction)) {
    return rest(wait->duration);
  }
  if (const auto* output = std::get_if<planning::GripperOutput>(&instruction)) {
    return fmt::format("  $OUT[{}]={}\n", output->number, output->closes ? "TRUE" : "FALSE");
  }
  if (const auto* output = std::get_if<planning::ArmOutput>(&instruction)) {
    return text_of(*output);
  }
  return "  ; " + std::get<planning::ArmComment>(instruction).text + "\n";
}

constexpr const char* kHeader = "&ACCESS RVP\n&REL 1\n";

/// Writes the check that ends the program unless the arm is at the first point. Then the move to it
/// is none, as the controller needs before other moves.
std::string start_check() {
  std::vector<std::string> axes;
  for (int j = 1; j <= 6; ++j) {
    axes.push_back(fmt::format("(ABS($AXIS_ACT.A{0}-XP0.A{0})>{1})", j, kStartTolerance));
  }
  return fmt::format(R"(  BAS(#INITMOV,0)
  IF {} THEN
    ; The arm is not where the motion begins.
    HALT
    RETURN
  ENDIF
  PTP XP0
)",
                     fmt::join(axes, " OR "));
}

constexpr const char* kRatesProgram = R"(
DEF HW_RATES(V:IN,A:IN)
  DECL INT V,A,I
  FOR I=1 TO 6
    $VEL_AXIS[I]=V
    $ACC_AXIS[I]=A
  ENDFOR
END
)";

std::string source(const std::string& name, const planning::Motion& motion,
                   const std::vector<planning::ArmInstruction>& instructions) {
  std::string text = fmt::format("{}DEF {}()\n", kHeader, name);
  for (const std::string& remark : program_heading(motion)) {
    text += "  ; " + remark + "\n";
  }
  text += start_check();
  for (const planning::ArmInstruction& instruction : instructions) {
    text += text_of(instruction, motion.speed);
  }
  return text + "END\n" + kRatesProgram;
}

std::string data_list(const std::string& name, const planning::Motion& motion,
                      const std::vector<planning::ArmInstruction>& instructions) {
  std::string text = fmt::format("{}DEFDAT {}\n  EXT BAS(BAS_COMMAND:IN,REAL:IN)\n", kHeader, name);
  text += declaration(0, motion.path.waypoints.front()(motion.arm));
  for (const planning::ArmInstruction& instruction : instructions) {
    if (const auto* move = std::get_if<planning::ArmMove>(&instruction)) {
      text += declaration(move->point, move->move.target);
    }
  }
  return text + "ENDDAT\n";
}

void check_output(const planning::ExportOptions& options) {
  if (const int output = options.gripper_output.value_or(1); output < 1 || output > kMostOutput) {
    throw geometric::InputError(
        {"gripper output", "", std::to_string(output), "1 to 4096 for KRL", ""});
  }
}

// Rounds a share down to whole per cent, at least one.
int per_cent(double share) {
  constexpr double kExact = 1e-9;
  return static_cast<int>(std::clamp(std::floor(100.0 * share + kExact), 1.0, 100.0));
}

}  // namespace

AxisRates axis_rates(const planning::JointMove& move, double speed) {
  AxisRates rates;
  rates.acceleration = per_cent(speed * speed);
  const double acceleration = 0.01 * rates.acceleration;
  rates.velocity = per_cent(std::min(move.velocity_share(acceleration), speed));
  const double lacking = move.duration - move.duration_at(0.01 * rates.velocity, acceleration);
  rates.pause = lacking > kRounding ? lacking : 0.0;
  return rates;
}

std::string KrlExporter::robot_objection(const planning::Motion& motion) const {
  return is_robot_named(motion, kKuka) ? std::string()
                                       : "an arm of KUKA: KRL runs on its KR C controllers alone";
}

std::string KrlExporter::output_objection(const geometric::OutputStep& output) const {
  return objection(output);
}

std::vector<planning::ExportedFile> KrlExporter::do_export(
    const planning::Motion& motion, const planning::ExportOptions& options) const {
  require_arm(
      motion,
      {.language = "KRL",
       .advice = "KR C controllers have the axes A1 to A6; an LBR iiwa is programmed in Java"});
  check_output(options);
  const std::vector<planning::ArmInstruction> instructions = arm_instructions(motion, options);
  const std::string name = planning::program_name(motion.name, kLongestName, kKeywords);
  std::vector<planning::ExportedFile> files = {
      {name + ".src", source(name, motion, instructions)},
      {name + ".dat", data_list(name, motion, instructions)}};
  std::ranges::move(hand_target_files(motion, options), std::back_inserter(files));
  return files;
}

}  // namespace handway::export_krl

HANDWAY_PLUGIN({.name = "export_krl", .version = HANDWAY_VERSION, .make_exporters = [] {
                  std::vector<std::unique_ptr<handway::planning::Exporter>> exporters;
                  exporters.push_back(std::make_unique<handway::export_krl::KrlExporter>());
                  return exporters;
                }});
