#include "kautham_problem.h"

#include "handway/geometric/io/number_text.h"
#include "xml_file.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string_view>

namespace handway::import_kautham {
namespace {

double read_scale(const XmlFile& xml, pugi::xml_node node) {
  const double scale = xml.number_or(node, "scale", 1.0);
  if (scale <= 0.0) {
    xml.refuse(node, "scale", xml.text(node, "scale"), "a number above 0",
               "1 for a mesh in millimetres, 1000 for one in metres");
  }
  return scale;
}

BaseLimits read_limits(const XmlFile& xml, pugi::xml_node robot, const Units& units) {
  BaseLimits limits{};
  for (const pugi::xml_node node : robot.children("Limits")) {
    const std::string name = xml.text(node, "name");
    for (std::size_t axis = 0; axis < limits.size(); ++axis) {
      if (name == std::array{"X", "Y", "Z"}[axis]) {
        limits[axis] = {units.length * xml.number(node, "min"),
                        units.length * xml.number(node, "max")};
      }
    }
  }
  return limits;
}

KauthamProblem::PlacedRobot read_robot(const XmlFile& xml, pugi::xml_node node,
                                       const Units& units) {
  xml.refuse_slips(node, {"Home", "Limits", "InvKinematic"});
  KauthamProblem::PlacedRobot robot{xml.text(node, "robot"), read_scale(xml, node)};
  if (const pugi::xml_node home = node.child("Home")) {
    robot.X_WH = read_location(xml, home, units);
  }
  robot.limits = read_limits(xml, node, units);
  return robot;
}

KauthamProblem::Obstacle read_obstacle(const XmlFile& xml, pugi::xml_node node,
                                       const Units& units) {
  return {xml.text(node, "scene"), read_scale(xml, node),
          read_location(xml, xml.child(node, "Location"), units)};
}

// Reads an obstacle of later versions; without a home it is at the origin.
KauthamProblem::Obstacle read_later_obstacle(const XmlFile& xml, pugi::xml_node node,
                                             const Units& units) {
  KauthamProblem::Obstacle obstacle{xml.text(node, "obstacle"), read_scale(xml, node)};
  if (const pugi::xml_node home = node.child("Home")) {
    obstacle.X_WO = read_location(xml, home, units);
  }
  return obstacle;
}

// The file does not name its unit: with URDF files, in metres and unscaled, it is the metre.
Units units_of(pugi::xml_node problem) {
  constexpr double kMostInMetres = 100.0;
  for (const pugi::xml_node node : problem.children()) {
    for (const char* name : {"robot", "obstacle"}) {
      const std::string_view file = geometric::trimmed(node.attribute(name).value());
      if (file.ends_with(".urdf") && node.attribute("scale").as_double(1.0) < kMostInMetres) {
        return {1.0, 1.0};
      }
    }
  }
  return {};
}

// Reads controls in [0, 1], separated by white space, as many as `dim`.
std::vector<double> read_controls(const XmlFile& xml, pugi::xml_node node) {
  std::vector<double> values;
  if (!node) {
    return values;
  }
  for (const std::string_view word : geometric::cells(node.child_value(), ' ')) {
    const std::optional<double> value = geometric::parse_number(word);
    if (!value || *value < 0.0 || *value > 1.0) {
      xml.refuse(node, "", fmt::format("\"{}\" as control {}", word, values.size() + 1),
                 "a number from 0 to 1");
    }
    values.push_back(*value);
  }
  const double dimension = xml.number_or(node, "dim", static_cast<double>(values.size()));
  if (dimension != static_cast<double>(values.size())) {
    xml.refuse(node, "dim", xml.text(node, "dim"),
               "the number of controls listed, " + std::to_string(values.size()));
  }
  return values;
}

void read_planner(const XmlFile& xml, pugi::xml_node node, KauthamProblem& problem) {
  const pugi::xml_node parameters = node.child("Parameters");
  problem.planner = geometric::trimmed(parameters.child("Name").child_value());
  if (const pugi::xml_node local = parameters.child("LocalPlanner")) {
    problem.parameters.emplace_back("LocalPlanner", geometric::trimmed(local.child_value()));
    if (local.attribute("stepSize")) {
      problem.parameters.emplace_back("stepSize", xml.text(local, "stepSize"));
    }
  }
  for (const pugi::xml_node parameter : parameters.children("Parameter")) {
    problem.parameters.emplace_back(xml.text(parameter, "name"),
                                    geometric::trimmed(parameter.child_value()));
  }
}

void read_query(const XmlFile& xml, pugi::xml_node planner, KauthamProblem& problem) {
  const pugi::xml_node query = planner.child("Queries").child("Query");
  if (!query) {
    problem.warnings.push_back("the problem has no <Query>: no start and no goal");
    return;
  }
  problem.query_place = xml.place(query);
  xml.refuse_slips(query, {"Init", "Goal"});
  problem.init = read_controls(xml, query.child("Init"));
  problem.goal = read_controls(xml, query.child("Goal"));
  if (problem.init.empty() || problem.goal.empty()) {
    problem.warnings.push_back(fmt::format("{}: the query has no {}", problem.query_place,
                                           !problem.init.empty()   ? "goal"
                                           : !problem.goal.empty() ? "start"
                                                                   : "start and no goal"));
  } else if (problem.init.size() != problem.goal.size()) {
    xml.refuse(query, "",
               std::to_string(problem.init.size()) + " controls in <Init> and " +
                   std::to_string(problem.goal.size()) + " in <Goal>",
               "as many in both");
  }
  if (const pugi::xml_node next = query.next_sibling("Query")) {
    problem.warnings.push_back(xml.place(next) + ": only the first <Query> is used");
  }
}

}  // namespace

KauthamProblem read_kautham_problem(const std::filesystem::path& file) {
  const XmlFile xml(file, "Problem");
  KauthamProblem problem;
  problem.file = file;
  problem.name = geometric::trimmed(xml.root().attribute("name").value());
  if (problem.name.empty()) {
    problem.name = file.stem().string();
  } else if (problem.name.ends_with(".xml")) {
    problem.name.resize(problem.name.size() - std::string_view(".xml").size());
  }
  xml.refuse_slips(xml.root(), {"Robot", "Scene", "Obstacle", "Controls", "Planner"});
  problem.units = units_of(xml.root());
  for (const pugi::xml_node node : xml.root().children("Robot")) {
    problem.robots.push_back(read_robot(xml, node, problem.units));
  }
  if (problem.robots.empty()) {
    xml.refuse(xml.root(), "", "no <Robot> in it", "at least one");
  }
  for (const pugi::xml_node node : xml.root().children("Scene")) {
    problem.obstacles.push_back(read_obstacle(xml, node, problem.units));
  }
  for (const pugi::xml_node node : xml.root().children("Obstacle")) {
    problem.obstacles.push_back(read_later_obstacle(xml, node, problem.units));
  }
  if (const pugi::xml_node controls = xml.root().child("Controls")) {
    problem.controls = xml.text(controls, "robot");
  }
  const pugi::xml_node planner = xml.root().child("Planner");
  read_planner(xml, planner, problem);
  read_query(xml, planner, problem);
  problem.warnings.insert(problem.warnings.end(), xml.notes().begin(), xml.notes().end());
  return problem;
}

}  // namespace handway::import_kautham
