#include "val3_exporter.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/extensions/exporter.h"
#include "handway/planning/extensions/plugin.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace handway::export_val3 {
namespace {

constexpr double kStill = 1e-9;       // rad: the arm stays
constexpr double kLeastShare = 1e-4;  // share of a limit

void check_arm(const planning::Motion& motion) {
  const auto turns = [&](int v) {
    return motion.model->variable(v).type == geometric::JointType::kRevolute;
  };
  if (motion.arm.size() != 6 || !std::ranges::all_of(motion.arm, turns)) {
    throw geometric::InputError(
        {"robot " + motion.model->name(), "", fmt::format("an arm of {} joints", motion.arm.size()),
         "six that turn, as VAL3's jointRx has", "The group \"arm\" of the SRDF file names them"});
  }
}

/// The speed and acceleration of a move's share done that the joints' limits allow.
struct ShareLimits {
  double velocity = std::numeric_limits<double>::infinity();      ///< 1/s
  double acceleration = std::numeric_limits<double>::infinity();  ///< 1/s²
};

ShareLimits share_limits(const planning::Motion& motion, const geometric::Configuration& delta) {
  ShareLimits limits;
  for (const int v : motion.arm) {
    const double change = std::abs(delta[v]);
    if (change > 0.0) {
      limits.velocity = std::min(limits.velocity, motion.limits.velocity[v] / change);
      limits.acceleration = std::min(limits.acceleration, motion.limits.acceleration[v] / change);
    }
  }
  return limits;
}

/// The top speed w of a move that takes `duration` in all: 1 / w + w / acceleration.
double top_speed(double duration, double acceleration) {
  const double half = 0.5 * acceleration * duration;
  return half - std::sqrt(std::max(0.0, half * half - acceleration));
}

}  // namespace

std::vector<ArmMove> arm_moves(const planning::Motion& motion) {
  check_arm(motion);
  std::vector<ArmMove> moves;
  const double acceleration = motion.speed * motion.speed;
  for (std::size_t w = 0; w < motion.path.waypoints.size(); ++w) {
    const geometric::Configuration& q = motion.path.waypoints[w];
    ArmMove move;
    for (std::size_t i = 0; i < move.point.size(); ++i) {
      move.point[i] = geometric::degrees(q[motion.arm[i]]);
    }
    move.velocity = 100.0 * motion.speed;
    move.acceleration = 100.0 * acceleration;
    if (w > 0) {
      const double duration = motion.waypoint_times[w] - motion.waypoint_times[w - 1];
      const geometric::Configuration delta = q - motion.path.waypoints[w - 1];
      const ShareLimits limits = share_limits(motion, delta);
      if (limits.velocity > 1.0 / kStill) {
        move.pause = duration;
      } else {
        const double speed = top_speed(duration, acceleration * limits.acceleration);
        move.velocity = 100.0 * std::clamp(speed / limits.velocity, kLeastShare, motion.speed);
      }
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
std::string number(double value) { return fmt::format("{:.6f}", value); }

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

std::string program(const char* name, std::initializer_list<Local> locals, const char* code) {
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
  add(node, "Code").append_child(pugi::node_cdata).set_value(code);
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

/// Writes NAME.dtx: `jPath` (deg), `mMove`, `nPause` (s), one of each for every point, `nPoints`,
/// `nTolerance` (deg) and `tHand`. No move blends into the next.
std::string data_file(const std::vector<ArmMove>& moves) {
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
      {{"key", "0"}, {"fatherId", "flange[0]"}, {"ioLink", "ValveIO\\valve1"}});
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

/// Writes runPath.pgx: refuses to run unless the arm is at the first point and all points are in
/// range; then goes from point to point.
std::string run_path_program() {
  return program("runPath", {{"l_i", "num"}, {"l_jHere", "jointRx"}}, R"(begin
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
  for l_i=1 to nPoints-1
    if nPause[l_i]>0
      waitEndMove()
      delay(nPause[l_i])
    else
      movej(jPath[l_i],tHand,mMove[l_i])
    endIf
  endFor
  waitEndMove()
end)");
}

// The maker's name, or a model of six axes: TX40 to TX200, TX2-40 to TX2-160, RX60 to RX270.
bool names_a_staubli(const std::string& text) {
  static const std::regex kNames("st(a|ae|\xc3\xa4)ubli|(^|[^a-z0-9])(tx|tx2|rx)[-_ ]?[0-9]{2,3}",
                                 std::regex::ECMAScript | std::regex::icase);
  return std::regex_search(text, kNames);
}

}  // namespace

std::string Val3Exporter::robot_objection(const planning::Motion& motion) const {
  const geometric::RobotModel& model = *motion.model;
  std::vector<std::string> names{model.name(), model.description().file.filename().string()};
  for (const int v : motion.arm) {
    names.push_back(model.variable(v).child);
  }
  return std::ranges::any_of(names, names_a_staubli)
             ? std::string()
             : "a Stäubli arm: VAL3 runs on its controller alone";
}

std::vector<planning::ExportedFile> Val3Exporter::do_export(const planning::Motion& motion) const {
  const std::vector<ArmMove> moves = arm_moves(motion);
  const std::filesystem::path folder = motion.name;
  return {{folder / (motion.name + ".dtx"), data_file(moves)},
          {folder / "runPath.pgx", run_path_program()},
          {folder / "start.pgx", start_program()},
          {folder / "stop.pgx", stop_program()},
          {folder / (motion.name + ".pjx"), project_file(motion.name)}};
}

}  // namespace handway::export_val3

HANDWAY_PLUGIN({.name = "export_val3", .version = HANDWAY_VERSION, .make_exporters = [] {
                  std::vector<std::unique_ptr<handway::planning::Exporter>> exporters;
                  exporters.push_back(std::make_unique<handway::export_val3::Val3Exporter>());
                  return exporters;
                }});
