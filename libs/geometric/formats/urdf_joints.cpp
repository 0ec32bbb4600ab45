#include "formats/urdf_joints.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/robot/base_joint.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

namespace handway::geometric {
namespace {

constexpr std::size_t kMostLinks = 2000;  // a longer chain could exhaust the stack
constexpr double kForever = std::numeric_limits<double>::infinity();

const std::vector<std::string> kJointTypes = {"revolute", "continuous", "prismatic",
                                              "fixed",    "planar",     "floating"};

void refuse_repeated_names(const UrdfElements& elements, const char* kind) {
  std::set<std::string> names;
  for (const pugi::xml_node& node : elements.document().root("robot").children(kind)) {
    const std::string name = elements.document().need(node, "name");
    if (!names.insert(name).second) {
      elements.refuse(node, "robot", fmt::format("a second {} \"{}\"", kind, name), "unique names");
    }
  }
}

void refuse_if_too_many(const UrdfElements& elements) {
  std::size_t count = 0;
  for (const pugi::xml_node& link : elements.document().root("robot").children("link")) {
    if (++count > kMostLinks) {
      elements.refuse(link, "robot", fmt::format("more links than {}", kMostLinks),
                      "a robot of fewer links");
    }
  }
}

// Returns whether a limit is so large that it means "no limit".
bool is_beyond(const pugi::xml_node& limit, const char* attribute, double side = 1.0) {
  const std::string text = limit.attribute(attribute).value();
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && side * value > UrdfElements::kLargestNumber;
}

// Follows `mimic` to an independent joint; q = m1 * (m2 * q2 + o2) + o1.
void resolve_mimic(Joint& joint, const std::vector<Joint>& joints, const std::string& where) {
  for (std::size_t steps = 0; joint.mimic; ++steps) {
    const auto leader = std::ranges::find(joints, joint.mimic->joint, &Joint::name);
    if (leader == joints.end() || !leader->mimic) {
      return;
    }
    if (steps > joints.size()) {
      throw InputError({where, "joint " + joint.name, "a mimic that leads back to itself",
                        "a joint that moves on its own",
                        "Take the mimic of one of the joints of the ring away"});
    }
    Mimic& mimic = *joint.mimic;
    mimic.offset += mimic.multiplier * leader->mimic->offset;
    mimic.multiplier *= leader->mimic->multiplier;
    mimic.joint = leader->mimic->joint;
  }
}

void resolve_all_mimics(const XmlDocument& document, RobotDescription& robot) {
  const std::vector<Joint> as_written = robot.joints;
  for (const pugi::xml_node& node : document.root("robot").children("joint")) {
    const std::string name = node.attribute("name").value();
    const auto joint = std::ranges::find(robot.joints, name, &Joint::name);
    if (joint != robot.joints.end()) {  // a moving base has joints of other names
      resolve_mimic(*joint, as_written, document.where(node));
    }
  }
}

void note_joints_without_range(RobotDescription& robot) {
  std::vector<std::string> names;
  for (const Joint& joint : robot.joints) {
    if (joint.type != JointType::kFixed && joint.limits.range() == 0.0) {
      names.push_back(joint.name);
    }
  }
  add_warning("joints that can't move, as their limits leave no range", names, robot.warnings);
}

// Narrows joints to the limits of a <safety_controller>. Exporters without such limits write
// zeros.
void keep_soft_limits(const XmlDocument& document, RobotDescription& robot) {
  for (const pugi::xml_node& node : document.root("robot").children("joint")) {
    const pugi::xml_node safety = node.child("safety_controller");
    const auto joint =
        std::ranges::find(robot.joints, std::string(node.attribute("name").value()), &Joint::name);
    if (!safety || joint == robot.joints.end() || joint->type == JointType::kFixed) {
      continue;
    }
    const auto limit = [&](const char* name) {
      const pugi::xml_attribute attribute = safety.attribute(name);
      const std::optional<double> value = parse_number(attribute.value());
      if (attribute && !value) {
        robot.warnings.push_back(
            fmt::format("joint {}: <safety_controller {}=\"{}\"> is no number and is not kept",
                        joint->name, name, attribute.value()));
      }
      return value;
    };
    const std::optional<double> lower = limit("soft_lower_limit");
    const std::optional<double> upper = limit("soft_upper_limit");
    if (lower.value_or(0.0) != 0.0 || upper.value_or(0.0) != 0.0) {
      narrow_limits(robot, *joint, lower, upper, "<safety_controller>");
    }
  }
}

// Returns the link that a <parent> or <child> names.
std::string link_at(const UrdfElements& elements, const pugi::xml_node& joint,
                    const std::string& element, const char* end,
                    const std::vector<std::string>& links) {
  const pugi::xml_node link = elements.only(joint, element, end);
  if (!link) {
    elements.refuse(joint, element, fmt::format("no <{}>", end),
                    fmt::format("<{} link=\"…\"/>", end));
  }
  std::string name = elements.document().need(link, "link");
  if (std::ranges::count(links, name) == 0) {
    elements.refuse(link, element, fmt::format("the unknown {} link \"{}\"", end, name),
                    "a link of the robot", advise_name(name, links));
  }
  return name;
}

// Refuses a joint without one of its links, which leaves several roots.
void refuse_unknown_ends(const UrdfElements& elements) {
  const pugi::xml_node robot = elements.document().root("robot");
  std::vector<std::string> links;
  for (const pugi::xml_node& link : robot.children("link")) {
    links.emplace_back(link.attribute("name").value());
  }
  for (const pugi::xml_node& joint : robot.children("joint")) {
    const std::string element = fmt::format("joint {}", joint.attribute("name").value());
    for (const char* end : {"parent", "child"}) {
      static_cast<void>(link_at(elements, joint, element, end, links));
    }
  }
}

}  // namespace

std::set<std::string> links_on_their_own(const UrdfElements& elements) {
  refuse_if_too_many(elements);
  refuse_repeated_names(elements, "link");
  refuse_repeated_names(elements, "joint");
  const pugi::xml_node robot = elements.document().root("robot");
  std::set<std::string> parents;
  std::set<std::string> children;
  for (const pugi::xml_node& joint : robot.children("joint")) {
    parents.insert(joint.child("parent").attribute("link").value());
    children.insert(joint.child("child").attribute("link").value());
  }
  std::set<std::string> alone;
  std::vector<std::string> roots;
  pugi::xml_node second;
  for (const pugi::xml_node& link : robot.children("link")) {
    const std::string name = link.attribute("name").value();
    if (children.contains(name)) {
      continue;
    }
    if (!parents.contains(name) && !parents.empty()) {
      alone.insert(name);
      continue;
    }
    roots.push_back(name);
    second = roots.size() == 2 ? link : second;
  }
  if (second) {
    refuse_unknown_ends(elements);
    elements.refuse(
        second, "robot",
        fmt::format("several links that no joint carries: \"{}\"", fmt::join(roots, "\", \"")),
        "one, the root", "Connect them by a fixed joint");
  }
  if (roots.empty()) {
    elements.refuse(
        robot, "robot",
        robot.child("link") ? "no link that is the root: a joint carries each of them" : "no links",
        "a tree of links with one root");
  }
  return alone;
}

UrdfJoints::UrdfJoints(UrdfElements& elements) : elements_(elements) {
  const pugi::xml_node robot = elements.document().root("robot");
  for (const pugi::xml_node& joint : robot.children("joint")) {
    joint_names_.emplace_back(joint.attribute("name").value());
  }
  for (const pugi::xml_node& link : robot.children("link")) {
    link_names_.emplace_back(link.attribute("name").value());
  }
}

void UrdfJoints::read_all(RobotDescription& robot) {
  const XmlDocument& document = elements_.document();
  for (const pugi::xml_node& joint : document.root("robot").children("joint")) {
    read(joint, robot);
  }
  resolve_all_mimics(document, robot);
  note_joints_without_range(robot);
  keep_soft_limits(document, robot);
}

void UrdfJoints::read(const pugi::xml_node& node, RobotDescription& robot) {
  Joint joint;
  joint.name = elements_.document().need(node, "name");
  const std::string element = "joint " + joint.name;
  const std::string type = elements_.document().need(node, "type");
  if (std::ranges::count(kJointTypes, type) == 0) {
    elements_.refuse(node, element, "type \"" + type + "\"",
                     fmt::format("{}", fmt::join(kJointTypes, ", ")));
  }
  joint.parent = read_end(node, element, "parent");
  joint.child = read_end(node, element, "child");
  if (!carried_.insert(joint.child).second) {
    elements_.refuse(node, element, "a second joint that carries link \"" + joint.child + "\"",
                     "one joint for each link", "Make a link of its own for each");
  }
  joint.X_PJ = elements_.origin(node, element);
  if (type == "planar" || type == "floating") {
    if (const pugi::xml_node mimic = node.child("mimic")) {
      elements_.refuse(mimic, element, "<mimic> of a joint of type " + type, "none");
    }
    // Without a normal a planar joint moves across z, as in MoveIt.
    const Eigen::Vector3d normal = read_axis(node, element, Eigen::Vector3d::UnitZ());
    add_base_joint(robot,
                   {joint.name, type == "planar" ? BaseMotion::kPlanar : BaseMotion::kFloating},
                   {joint.parent, joint.child, joint.X_PJ, normal});
    return;
  }
  if (type != "fixed") {
    joint.type = type == "prismatic" ? JointType::kPrismatic : JointType::kRevolute;
    joint.axis = read_axis(node, element, Eigen::Vector3d::UnitX());
    joint.limits = read_limits(node, element, type);
    joint.mimic = read_mimic(node, element);
  }
  robot.joints.push_back(std::move(joint));
}

std::string UrdfJoints::read_end(const pugi::xml_node& joint, const std::string& element,
                                 const char* end) const {
  return link_at(elements_, joint, element, end, link_names_);
}

Eigen::Vector3d UrdfJoints::read_axis(const pugi::xml_node& joint, const std::string& element,
                                      const Eigen::Vector3d& otherwise) const {
  const pugi::xml_node axis = elements_.only(joint, element, "axis");
  if (!axis) {
    return otherwise;
  }
  static_cast<void>(elements_.document().need(axis, "xyz"));
  const std::vector<double> xyz = elements_.numbers(axis, element, "xyz", 3);
  const Eigen::Vector3d direction(xyz[0], xyz[1], xyz[2]);
  if (direction.norm() < 1e-9) {
    elements_.refuse(axis, element, "an axis without direction", "an axis such as \"0 0 1\"");
  }
  return direction.normalized();
}

// A continuous joint has no limits but of its velocity.
JointLimits UrdfJoints::read_limits(const pugi::xml_node& joint, const std::string& element,
                                    const std::string& type) {
  JointLimits limits;
  const pugi::xml_node limit = elements_.only(joint, element, "limit");
  if (!limit && type != "continuous") {
    elements_.refuse(joint, element, "no <limit>",
                     R"(<limit lower="…" upper="…" effort="…" velocity="…"/>)",
                     "A joint that turns without end is of type continuous");
  }
  const double velocity =
      is_beyond(limit, "velocity") ? 0.0 : elements_.number(limit, element, "velocity", 0.0);
  if (velocity < 0.0) {
    elements_.refuse(limit, element,
                     fmt::format("velocity=\"{}\"", limit.attribute("velocity").value()),
                     "0 or more", "Write 0 if it is not known");
  }
  limits.velocity = velocity > 0.0 ? velocity : limits.velocity;
  const bool is_endless = is_beyond(limit, "lower", -1.0) && is_beyond(limit, "upper");
  if (type == "continuous" || (is_endless && type == "revolute")) {
    limits.lower = -kForever;
    limits.upper = kForever;
  } else if (is_endless) {
    limits.lower = -kDefaultBaseReach;
    limits.upper = kDefaultBaseReach;
  } else {
    limits.lower = elements_.number(limit, element, "lower", 0.0);
    limits.upper = elements_.number(limit, element, "upper", 0.0);
  }
  if (is_endless && type != "continuous") {
    (type == "revolute" ? endless_ : endless_slides_).emplace_back(joint.attribute("name").value());
  }
  if (limits.lower > limits.upper && limit.attribute("lower") && limit.attribute("upper")) {
    elements_.refuse(
        limit, element,
        fmt::format("a lower limit of {} above the upper one of {}",
                    limit.attribute("lower").value(), limit.attribute("upper").value()),
        "lower below upper", "Swap them");
  }
  if (limits.lower > limits.upper) {
    const char* const given = limit.attribute("lower") ? "lower" : "upper";
    elements_.refuse(limit, element,
                     fmt::format("{}=\"{}\" alone, so that the other limit is 0", given,
                                 limit.attribute(given).value()),
                     "lower below upper", "Write both limits");
  }
  return limits;
}

std::optional<Mimic> UrdfJoints::read_mimic(const pugi::xml_node& joint,
                                            const std::string& element) const {
  const pugi::xml_node mimic = elements_.only(joint, element, "mimic");
  if (!mimic) {
    return std::nullopt;
  }
  const std::string leader = elements_.document().need(mimic, "joint");
  if (std::ranges::count(joint_names_, leader) == 0) {
    elements_.refuse(mimic, element, "a mimic of the unknown joint \"" + leader + "\"",
                     "a joint of the robot", advise_name(leader, joint_names_));
  }
  return Mimic{leader, elements_.number(mimic, element, "multiplier", 1.0),
               elements_.number(mimic, element, "offset", 0.0)};
}

}  // namespace handway::geometric
