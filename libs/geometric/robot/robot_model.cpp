#include "handway/geometric/robot/robot_model.h"

#include "handway/geometric/io/input_error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <unordered_map>
#include <utility>

namespace handway::geometric {
namespace {

[[noreturn]] void refuse(const RobotDescription& robot, const std::string& element,
                         const std::string& found, const std::string& expected,
                         const std::string& advice = "") {
  const std::string source = robot.file.empty() ? "robot " + robot.name : robot.file.string();
  throw InputError({source, element, found, expected, advice});
}

void check_names(const RobotDescription& robot) {
  std::set<std::string> links;
  for (const Link& link : robot.links) {
    if (!links.insert(link.name).second) {
      refuse(robot, "link " + link.name, "two links of this name", "unique names");
    }
  }
  if (links.empty()) {
    refuse(robot, "", "no link", "at least one link");
  }
  std::set<std::string> joints;
  for (const Joint& joint : robot.joints) {
    if (!joints.insert(joint.name).second) {
      refuse(robot, "joint " + joint.name, "two joints of this name", "unique names");
    }
    for (const std::string& end : {joint.parent, joint.child}) {
      if (!links.contains(end)) {
        refuse(robot, "joint " + joint.name, "unknown link \"" + end + "\"", "a link of the robot");
      }
    }
  }
}

void check_joint(const RobotDescription& robot, const Joint& joint) {
  const std::string element = "joint " + joint.name;
  if (!joint.X_PJ.matrix().allFinite()) {
    refuse(robot, element, "an origin that is not a number", "finite numbers");
  }
  if (joint.type == JointType::kFixed) {
    return;
  }
  if (!joint.axis.allFinite() || std::abs(joint.axis.norm() - 1.0) > 1e-6) {
    refuse(robot, element, "an axis of length " + std::to_string(joint.axis.norm()),
           "a unit vector");
  }
  const JointLimits& limits = joint.limits;
  if (!std::isfinite(limits.lower) || !std::isfinite(limits.upper) || limits.lower > limits.upper) {
    refuse(robot, element,
           "limits " + std::to_string(limits.lower) + " to " + std::to_string(limits.upper),
           "finite limits, lower below upper",
           "A joint that turns without end needs limits too, for example -6.2832 to 6.2832");
  }
}

}  // namespace

RobotModel::RobotModel(RobotDescription description) : description_(std::move(description)) {
  check_names(description_);
  for (const Joint& joint : description_.joints) {
    check_joint(description_, joint);
  }
  sort_parents_first();
  index_variables();
}

void RobotModel::sort_parents_first() {
  std::unordered_map<std::string, const Joint*> carrier;
  std::unordered_map<std::string, std::vector<const Joint*>> children;
  for (const Joint& joint : description_.joints) {
    if (!carrier.emplace(joint.child, &joint).second) {
      refuse(description_, "link " + joint.child, "two parent joints", "a tree: one parent each");
    }
    children[joint.parent].push_back(&joint);
  }
  std::vector<const Link*> roots;
  std::unordered_map<std::string, const Link*> by_name;
  for (const Link& link : description_.links) {
    by_name[link.name] = &link;
    if (!carrier.contains(link.name)) {
      roots.push_back(&link);
    }
  }
  if (roots.size() != 1) {
    refuse(description_, "", std::to_string(roots.size()) + " root links", "one root link",
           "Join the parts with fixed joints");
  }
  std::vector<Link> links;
  std::vector<Joint> joints;
  // Depth first, children in file order, so that a finger's joints stay together.
  const std::function<void(const Link&, int)> visit = [&](const Link& link, int parent) {
    const int index = static_cast<int>(links.size());
    links.push_back(link);
    parents_.push_back(parent);
    for (const Joint* joint : children[link.name]) {
      joints.push_back(*joint);
      visit(*by_name.at(joint->child), index);
    }
  };
  visit(*roots.front(), -1);
  if (links.size() != description_.links.size()) {
    refuse(description_, "", "joints that form a loop", "a tree");
  }
  description_.links = std::move(links);
  description_.joints = std::move(joints);
}

void RobotModel::index_variables() {
  drives_.resize(description_.links.size());
  for (int i = 1; i < link_count(); ++i) {
    if (joint(i).type != JointType::kFixed && !joint(i).mimic) {
      drives_[static_cast<std::size_t>(i)].variable = variable_count();
      variable_links_.push_back(i);
    }
  }
  for (int i = 1; i < link_count(); ++i) {
    if (joint(i).type == JointType::kFixed || !joint(i).mimic) {
      continue;
    }
    const Mimic& mimic = *joint(i).mimic;
    const std::optional<int> leader = find_variable(mimic.joint);
    if (!leader) {
      refuse(description_, "joint " + joint(i).name, "coupling to \"" + mimic.joint + "\"",
             "a joint that moves on its own");
    }
    drives_[static_cast<std::size_t>(i)] = {*leader, mimic.multiplier, mimic.offset};
  }
  for (int i = 1; i < link_count(); ++i) {
    const auto& [variable, multiplier, offset] = drive(i);
    steps_.push_back(forward_kinematics_step(joint(i), parent(i), variable, multiplier, offset));
  }
  lower_.resize(variable_count());
  upper_.resize(variable_count());
  for (int v = 0; v < variable_count(); ++v) {
    lower_[v] = variable(v).limits.lower;
    upper_[v] = variable(v).limits.upper;
  }
}

std::optional<int> RobotModel::find_link(std::string_view name) const {
  const auto& links = description_.links;
  const auto found = std::ranges::find(links, name, &Link::name);
  return found == links.end() ? std::nullopt
                              : std::optional(static_cast<int>(found - links.begin()));
}

std::optional<int> RobotModel::find_variable(std::string_view joint_name) const {
  for (int v = 0; v < variable_count(); ++v) {
    if (variable(v).name == joint_name) {
      return v;
    }
  }
  return std::nullopt;
}

std::optional<std::vector<int>> RobotModel::find_group(std::string_view name) const {
  const auto group = std::ranges::find(description_.groups, name, &JointGroup::name);
  if (group == description_.groups.end()) {
    return std::nullopt;
  }
  std::vector<int> variables;
  for (const std::string& joint : group->joints) {
    if (const std::optional<int> variable = find_variable(joint)) {
      variables.push_back(*variable);
    }
  }
  std::ranges::sort(variables);
  return variables;
}

Configuration RobotModel::neutral() const {
  const Configuration middle = 0.5 * (lower_ + upper_);
  return (lower_.array() <= 0.0 && upper_.array() >= 0.0)
      .select(Configuration::Zero(variable_count()), middle);
}

bool RobotModel::moves_between(int variable, int link_a, int link_b) const {
  // A joint moves one link against the other if it is above exactly one of them.
  const auto is_above = [&](int moved, int link) {
    while (link > moved) {
      link = parent(link);
    }
    return link == moved;
  };
  for (int i = 1; i < link_count(); ++i) {
    if (drive(i).variable == variable && is_above(i, link_a) != is_above(i, link_b)) {
      return true;
    }
  }
  return false;
}

std::vector<JointValue> joint_values(const RobotModel& model, const Configuration& q) {
  std::vector<JointValue> values;
  for (int i = 1; i < model.link_count(); ++i) {
    const RobotModel::Drive& drive = model.drive(i);
    if (drive.variable >= 0) {
      values.push_back({model.joint(i).name, drive.multiplier * q[drive.variable] + drive.offset});
    }
  }
  return values;
}

}  // namespace handway::geometric
