#include "val3_exporter.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/extensions/arm_program.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/extensions/program_text.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace handway::export_val3 {
namespace {

constexpr double kLeastShare = 1e-4;  // share of a limit

}  // namespace

std::vector<ArmMove> arm_moves(const planning::Motion& motion) {
  require_arm(motion, {.language = "VAL3, as its type jointRx has"});
  const double acceleration = motion.speed * motion.speed;
  const auto move_to = [&](const Eigen::VectorXd& target) {
    ArmMove move;
    std::ranges::transform(target, move.point.begin(), geometric::degrees);
    move.velocity = 100.0 * motion.speed;
    move.acceleration = 100.0 * acceleration;
    return move;
  };
  std::vector<ArmMove> moves{move_to(motion.path.waypoints.front()(motion.arm))};
  for (const planning::JointMove& of_arm : joint_moves(motion)) {
    ArmMove move = move_to(of_arm.target);
    if (of_arm.waits) {
      move.pause = of_arm.duration;
    } else {
      move.velocity =
          100.0 * std::clamp(of_arm.velocity_share(acceleration), kLeastShare, motion.speed);
    }
    moves.push_back(move);
  }
  return moves;
}

namespace {

/// Largest distance (deg) of the arm from the first point when the program starts.
constexpr double kStartTolerance = 0.1;

using Attributes = std::initializer_list<std::pair<const char*, std::string>>;

constexpr const char* kNamespace = "http://www.staubli.com/robotics/VAL3/";
constexpr const char* kInstance = "http://www.w3.org/2001/XMLSchema-instance";

pugi::xml_node add(pugi::xml_node parent, const char* name, const Attributes& attributes = {}) {
  pugi::xml_node node = parent.append_child(name);
  for (const auto& [key, value] : attributes) {
    node.append_attribute(key).set_value(value.c_str());
  }
  return node;
}

std::string text_of(pugi::xml_document& document) {
  pugi::xml_node declaration = document.prepend_child(pugi::node_declaration);
  declaration.append_attribute("version").set_value("1.0");
  declaration.append_attribute("encoding").set_value("utf-8");
  std::ostringstream text;
  document.save(text, "  ");
  return text.str();
}

/// Writes numbers without an exponent, as VAL3's literals.
std::string number(double value) { return planning::fixed_decimals(value, 6); }

pugi::xml_node add_data(pugi::xml_node all, const char* name, const char* type, std::size_t size) {
  return add(all, "Data",
             {{"name", name},
              {"access", "public"},
              {"xsi:type", "array"},
              {"type", type},
              {"size", std::to_string(size)}});
}

void add_number(pugi::xml_node all, const char* name, double value) {
  add(add_data(all, name, "num", 1), "Value", {{"key", "0"}, {"value", fmt::format("{}", value)}});
}

struct Local {
  const char* name;
  const char* type;
};

std::string program(const char* name, std::initializer_list<Local> locals,
                    const std::string& code) {
  pugi::xml_document document;
  pugi::xml_node node =
      add(add(document.root(), "Programs",
              {{"xmlns:xsi", kInstance}, {"xmlns", std::string(kNamespace) + "Program/2"}}),
          "Program", {{"name", name}, {"access", "public"}});
  if (locals.size() > 0) {
    pugi::xml_node list = add(node, "Locals");
    for (const Local& local : locals) {
      add(list, "Local",
          {{"name", local.name}, {"type", local.type}, {"xsi:type", "array"}, {"size", "1"}});
    }
  }
  add(node, "Code").append_child(pugi::node_cdata).set_value(code.c_str());
  return text_of(document);
}

/// Writes NAME.pjx: the list of programs and data.
std::string project_file(const std::string& name) {
  pugi::xml_document document;
  pugi::xml_node project =
      add(document.root(), "Project", {{"xmlns", std::string(kNamespace) + "Project/3"}});
  add(project, "Parameters",
      {{"version", "s7.11"}, {"stackSize", "5000"}, {"millimeterUnit", "true"}});
  pugi::xml_node programs = add(project, "Programs");
  for (const char* file : {"runPath.pgx", "start.pgx", "stop.pgx"}) {
    add(programs, "Program", {{"file", file}});
  }
  add(add(project, "Database"), "Data", {{"file", name + ".dtx"}});
  add(project, "Libraries");
  return text_of(document);
}

/// The outputs that a program sets, as arrays of variables that are linked to the controller's.
class LinkedOutputs {
 public:
  explicit LinkedOutputs(const planning::Motion& motion) {
    for (const geometric::OutputStep& output : outputs_of(motion)) {
      std::vector<std::string>& links = links_of(output);
      const std::string link = link_of(output);
      if (!link.empty() && std::ranges::count(links, link) == 0) {
        links.push_back(link);
      }
    }
  }

  /// Returns the controller's name of an output: its own, or output N of the first basic board.
  /// Empty if it has none.
  static std::string link_of(const geometric::OutputStep& output) {
    constexpr int kMostOutput = 15;
    if (output.name.find('\\') != std::string::npos) {
      return output.name;
    }
    const std::optional<int> number = planning::output_number(output.name);
    return number && *number <= kMostOutput && is_digital(output)
               ? fmt::format("BasicIO-1\\%Q{}", *number)
               : std::string();
  }

  /// Adds the arrays `dOutput` and `aOutput`, if there are outputs of their kind.
  void add_to(pugi::xml_node all) const {
    add_array(all, "dOutput", "dio", digital_);
    add_array(all, "aOutput", "aio", analog_);
  }

  /// Returns the code that sets an output.
  [[nodiscard]] std::string code(const geometric::OutputStep& output) const {
    const std::string link = link_of(output);
    if (link.empty()) {
      return fmt::format("  // {}\n", planning::unset_output_comment(output));
    }
    const std::vector<std::string>& links = is_digital(output) ? digital_ : analog_;
    const auto index = std::ranges::find(links, link) - links.begin();
    const std::string set =
        is_digital(output)
            ? fmt::format("dOutput[{}]={}", index, value_text(output))
            : fmt::format("aioSet(aOutput[{}],{})", index, number(std::get<double>(output.value)));
    return fmt::format("  waitEndMove()\n  {}\n", set);
  }

 private:
  static bool is_digital(const geometric::OutputStep& output) {
    return std::holds_alternative<bool>(output.value);
  }
  std::vector<std::string>& links_of(const geometric::OutputStep& output) {
    return is_digital(output) ? digital_ : analog_;
  }
  static void add_array(pugi::xml_node all, const char* name, const char* type,
                        const std::vector<std::string>& links) {
    if (links.empty()) {
      return;
    }
    pugi::xml_node array = add_data(all, name, type, links.size());
    for (std::size_t i = 0; i < links.size(); ++i) {
      add(array, "Value", {{"key", std::to_string(i)}, {"link", links[i]}});
    }
  }

  std::vector<std::string> digital_;
  std::vector<std::string> analog_;
};

/// Writes NAME.dtx: `jPath` (deg), `mMove`, `nPause` (s), one of each for every point, `nPoints`,
/// `nTolerance` (deg), `tHand` and the outputs. No move blends into the next.
/// @param valve of the tool, 1 or 2.
std::string data_file(const std::vector<ArmMove>& moves, int valve, const LinkedOutputs& outputs) {
  pugi::xml_document document;
  pugi::xml_node all =
      add(add(document.root(), "Database",
              {{"xmlns:xsi", kInstance}, {"xmlns", std::string(kNamespace) + "Data/2"}}),
          "Datas");
  pugi::xml_node points = add_data(all, "jPath", "jointRx", moves.size());
  pugi::xml_node descriptors = add_data(all, "mMove", "mdesc", moves.size());
  pugi::xml_node pauses = add_data(all, "nPause", "num", moves.size());
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const ArmMove& move = moves[i];
    const std::string key = std::to_string(i);
    add(points, "Value",
        {{"key", key},
         {"j1", number(move.point[0])},
         {"j2", number(move.point[1])},
         {"j3", number(move.point[2])},
         {"j4", number(move.point[3])},
         {"j5", number(move.point[4])},
         {"j6", number(move.point[5])}});
    add(descriptors, "Value",
        {{"key", key},
         {"accel", number(move.acceleration)},
         {"vel", number(move.velocity)},
         {"decel", number(move.acceleration)},
         {"tmax", "99999"},
         {"rmax", "99999"},
         {"blend", "off"},
         {"leave", "0"},
         {"reach", "0"}});
    add(pauses, "Value", {{"key", key}, {"value", number(move.pause)}});
  }
  add_number(all, "nPoints", static_cast<double>(moves.size()));
  add_number(all, "nTolerance", kStartTolerance);
  add(add_data(all, "tHand", "tool", 1), "Value",
      {{"key", "0"},
       {"fatherId", "flange[0]"},
       {"ioLink", fmt::format("ValveIO\\valve{}", valve)}});
  outputs.add_to(all);
  return text_of(document);
}

/// Writes start.pgx: waits for power and calls runPath.
std::string start_program() {
  return program("start", {}, R"(begin
  if isPowered()==false
    enablePower()
    wait(isPowered())
  endIf
  call runPath()
end)");
}

/// Writes stop.pgx, which discards the remaining motion.
std::string stop_program() {
  return program("stop", {}, R"(begin
  resetMotion()
end)");
}

// Adds a loop over the moves to the points from `first` to `last`.
void add_loop(std::size_t first, std::size_t last, std::string& code) {
  code += fmt::format(R"(  for l_i={} to {}
    if nPause[l_i]>0
      waitEndMove()
      delay(nPause[l_i])
    else
      movej(jPath[l_i],tHand,mMove[l_i])
    endIf
  endFor
)",
                      first, last);
}

/// Writes the instructions as loops over the points, and between these the comments, waits that no
/// point has, the tool and outputs.
std::string moves_code(const std::vector<planning::ArmInstruction>& instructions,
                       const LinkedOutputs& outputs) {
  std::string code;
  std::size_t first = 1;  // point that no loop has yet
  std::size_t next = 1;
  const auto end_loop = [&] {
    if (next > first) {
      add_loop(first, next - 1, code);
    }
    first = next;
  };
  for (const planning::ArmInstruction& instruction : instructions) {
    if (std::holds_alternative<planning::ArmMove>(instruction)) {
      ++next;
    } else if (const auto* wait = std::get_if<planning::ArmWait>(&instruction)) {
      if (wait->is_waypoint) {
        ++next;
      } else {
        end_loop();
        code += fmt::format("  waitEndMove()\n  delay({})\n", number(wait->duration));
      }
    } else if (const auto* output = std::get_if<planning::GripperOutput>(&instruction)) {
      end_loop();
      code += output->closes ? "  close(tHand)\n" : "  open(tHand)\n";
    } else if (const auto* set = std::get_if<planning::ArmOutput>(&instruction)) {
      end_loop();
      code += outputs.code(set->output);
    } else {
      end_loop();
      code += "  // " + std::get<planning::ArmComment>(instruction).text + "\n";
    }
  }
  end_loop();
  return code;
}

/// Writes runPath.pgx: refuses to run unless the arm is at the first point and all points are in
/// range; then goes from point to point.
std::string run_path_program(const std::vector<planning::ArmInstruction>& instructions,
                             const LinkedOutputs& outputs) {
  return program("runPath", {{"l_i", "num"}, {"l_jHere", "jointRx"}},
                 R"(begin
  l_jHere=herej()
  if abs(l_jHere.j1-jPath[0].j1)>nTolerance or abs(l_jHere.j2-jPath[0].j2)>nTolerance or abs(l_jHere.j3-jPath[0].j3)>nTolerance or abs(l_jHere.j4-jPath[0].j4)>nTolerance or abs(l_jHere.j5-jPath[0].j5)>nTolerance or abs(l_jHere.j6-jPath[0].j6)>nTolerance
    popUpMsg("the arm does not stand where the path begins")
    return
  endIf
  for l_i=0 to nPoints-1
    if isInRange(jPath[l_i])==false
      popUpMsg("a point of the path is out of range")
      return
    endIf
  endFor
)" + moves_code(instructions, outputs) +
                     R"(  waitEndMove()
end)");
}

// The maker's name, or a model of six axes: TX40 to TX200, TX2-40 to TX2-160, RX60 to RX270.
constexpr const char* kStaubli = "st(a|ae|\xc3\xa4)ubli|(^|[^a-z0-9])(tx|tx2|rx)[-_ ]?[0-9]{2,3}";

// Returns the valve of the tool. @throws InputError for an output that is none.
int valve_of(const planning::ExportOptions& options) {
  const int valve = options.gripper_output.value_or(1);
  if (valve != 1 && valve != 2) {
    throw geometric::InputError(
        {"gripper output", "", std::to_string(valve), "1 or 2 for VAL3, a valve of the arm", ""});
  }
  return valve;
}

}  // namespace

std::string Val3Exporter::robot_objection(const planning::Motion& motion) const {
  return is_robot_named(motion, kStaubli) ? std::string()
                                          : "a Stäubli arm: VAL3 runs on its controller alone";
}

std::string Val3Exporter::output_objection(const geometric::OutputStep& output) const {
  return LinkedOutputs::link_of(output).empty()
             ? std::string(
                   R"(VAL3 sets outputs by their links, such as "BasicIO-1\%Q3", or digital )"
                   "ones by a number up to 15 at the end of the name")
             : std::string();
}

std::vector<planning::ExportedFile> Val3Exporter::do_export(
    const planning::Motion& motion, const planning::ExportOptions& options) const {
  const std::vector<ArmMove> moves = arm_moves(motion);
  const LinkedOutputs outputs(motion);
  const std::filesystem::path folder = motion.name;
  std::vector<planning::ExportedFile> files = {
      {folder / (motion.name + ".dtx"), data_file(moves, valve_of(options), outputs)},
      {folder / "runPath.pgx", run_path_program(arm_instructions(motion, options), outputs)},
      {folder / "start.pgx", start_program()},
      {folder / "stop.pgx", stop_program()},
      {folder / (motion.name + ".pjx"), project_file(motion.name)}};
  std::ranges::move(hand_target_files(motion, options), std::back_inserter(files));
  return files;
}

}  // namespace handway::export_val3

HANDWAY_PLUGIN({.name = "export_val3", .version = HANDWAY_VERSION, .make_exporters = [] {
                  std::vector<std::unique_ptr<handway::planning::Exporter>> exporters;
                  exporters.push_back(std::make_unique<handway::export_val3::Val3Exporter>());
                  return exporters;
                }});
