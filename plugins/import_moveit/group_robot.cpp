#include "group_robot.h"

#include "handway/geometric/io/nearest_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <vector>

namespace handway::import_moveit {
namespace {

using geometric::Configuration;
using geometric::Joint;
using geometric::JointType;
using geometric::Pose;
using geometric::RobotDescription;
using geometric::RobotModel;
using geometric::YamlElement;

// The motion of a joint by `value`.
Pose moved(const Joint& joint, double value) {
  Pose X = joint.X_PJ;
  if (joint.type == JointType::kRevolute) {
    X.rotate(Eigen::AngleAxisd(value, joint.axis.normalized()));
  } else if (joint.type == JointType::kPrismatic) {
    X.translate(value * joint.axis.normalized());
  }
  return X;
}

std::vector<int> variables_of(const RobotModel& model, const YamlElement& group) {
  const std::optional<std::vector<int>> variables = model.find_group(group.text());
  if (variables && !variables->empty()) {
    return *variables;
  }
  std::vector<std::string> names;
  std::ranges::transform(model.description().groups, std::back_inserter(names),
                         &geometric::JointGroup::name);
  group.refuse(fmt::format("the group \"{}\", {}", group.text(),
                           variables ? "of which no joint moves" : "which the robot has not"),
               "a group of the robot's SRDF", geometric::advise_name(group.text(), names));
}

}  // namespace

Configuration with_values(const RobotModel& model, const std::map<std::string, double>& values,
                          const Configuration& rest, std::set<std::string>& unknown) {
  Configuration q = rest;
  for (const auto& [name, value] : values) {
    if (const std::optional<int> variable = model.find_variable(name)) {
      q[*variable] = value;
      continue;
    }
    const std::vector<Joint>& joints = model.description().joints;
    if (std::ranges::find(joints, name, &Joint::name) == joints.end()) {
      unknown.insert(name);
    }
  }
  return q;
}

std::shared_ptr<const RobotModel> group_robot(const RobotModel& model, const YamlElement& group,
                                              const Configuration& start) {
  const std::vector<int> kept = variables_of(model, group);
  RobotDescription description = model.description();
  for (int link = 1; link < model.link_count(); ++link) {
    const RobotModel::Drive& drive = model.drive(link);
    if (drive.variable < 0 || std::ranges::count(kept, drive.variable) != 0) {
      continue;
    }
    const double value = drive.multiplier * start[drive.variable] + drive.offset;
    const auto joint = std::ranges::find(description.joints, model.joint(link).name, &Joint::name);
    joint->X_PJ = moved(*joint, value);
    joint->type = JointType::kFixed;
    joint->mimic.reset();
  }
  std::erase_if(description.groups,
                [](const geometric::JointGroup& other) { return other.name != "hand"; });
  description.postures.clear();
  return std::make_shared<const RobotModel>(std::move(description));
}

}  // namespace handway::import_moveit
