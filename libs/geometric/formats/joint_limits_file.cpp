#include "handway/geometric/formats/joint_limits_file.h"

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <span>
#include <system_error>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

// Names of the joints that a file should have: those that move on their own.
std::vector<std::string> independent_joints(const RobotDescription& robot) {
  std::vector<std::string> names;
  for (const Joint& joint : robot.joints) {
    if (joint.type != JointType::kFixed && !joint.mimic) {
      names.push_back(joint.name);
    }
  }
  return names;
}

// A file may have joints of other robots, such as the gripper on it. But a name that is almost that
// of a missing joint is refused as a misspelling.
void refuse_slip(const YamlElement& limits, const YamlElement& joint, const std::string& name,
                 std::span<const std::string> joints) {
  std::vector<std::string> left_out;
  std::ranges::copy_if(joints, std::back_inserter(left_out),
                       [&](const std::string& other) { return !limits.find(other); });
  if (!slip_of(name, left_out)) {
    return;
  }
  constexpr std::size_t kFew = 3;
  joint.refuse(
      fmt::format("\"{}\"", name), "a joint of the robot",
      fmt::format("The nearest are {}.", fmt::join(nearest_names(name, left_out, kFew), ", ")));
}

bool is_denied(const YamlElement& joint, const std::string& flag) {
  const auto element = joint.find(flag);
  return element && !element->flag();
}

// The limit of a rate, if the joint's map has a valid one.
std::optional<double> rate(const YamlElement& joint, const std::string& name) {
  const auto element = joint.find("max_" + name);
  if (!element || is_denied(joint, "has_" + name + "_limits")) {
    return std::nullopt;
  }
  if (element->number() <= 0.0) {
    element->refuse(element->found(), "a number above 0");
  }
  return element->number();
}

std::optional<double> position(const YamlElement& joint, const std::string& flag,
                               const std::string& key) {
  const auto element = joint.find(key);
  return element && !is_denied(joint, flag) ? std::optional(element->number()) : std::nullopt;
}

// @param better whether the first of two limits counts.
template <typename Better>
std::optional<double> either(std::optional<double> a, std::optional<double> b,
                             const Better& better) {
  return a && b ? std::optional(better(*a, *b) ? *a : *b) : a ? a : b;
}

FiledJointLimits limits_of(const YamlElement& joint, const std::string& name) {
  // Every key that ROS has in such files.
  joint.allow_keys({"has_velocity_limits", "max_velocity", "has_acceleration_limits",
                    "max_acceleration", "has_jerk_limits", "max_jerk", "has_position_limits",
                    "min_position", "max_position", "has_deceleration_limits", "max_deceleration",
                    "has_effort_limits", "max_effort", "angle_wraparound", "has_soft_limits",
                    "soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity"});
  const char* const flag = "has_position_limits";
  const char* const soft = "has_soft_limits";
  FiledJointLimits limits{
      name,
      rate(joint, "velocity"),
      either(rate(joint, "acceleration"), rate(joint, "deceleration"), std::less()),
      rate(joint, "jerk"),
      either(position(joint, flag, "min_position"), position(joint, soft, "soft_lower_limit"),
             std::greater()),
      either(position(joint, flag, "max_position"), position(joint, soft, "soft_upper_limit"),
             std::less())};
  if (limits.lower && limits.upper && *limits.lower > *limits.upper) {
    joint.refuse(fmt::format("positions from {:g} to {:g}", *limits.lower, *limits.upper),
                 "a least position below the greatest");
  }
  return limits;
}

}  // namespace

std::vector<FiledJointLimits> read_joint_limits(const fs::path& file,
                                                const RobotDescription& robot) {
  YamlElement top = YamlElement::read(file, "a file of joint limits (YAML)");
  for (const char* around : {"/**", "ros__parameters", "robot_description_planning"}) {
    top = top.find(around).value_or(top);
  }
  const YamlElement limits = top.need("joint_limits");
  const std::vector<std::string> joints = independent_joints(robot);
  std::vector<FiledJointLimits> all;
  for (const auto& [name, joint] : limits.entries()) {
    if (std::ranges::count(robot.joints, name, &Joint::name) == 0) {
      refuse_slip(limits, joint, name, joints);
    }
    all.push_back(limits_of(joint, name));
  }
  return all;
}

fs::path joint_limits_beside(const RobotDescription& robot) {
  std::error_code ignored;
  const fs::path file = robot.file.parent_path() / "joint_limits.yaml";
  return !robot.file.empty() && fs::is_regular_file(file, ignored) ? file : fs::path();
}

void narrow_joint_limits(RobotDescription& robot) {
  const fs::path file = joint_limits_beside(robot);
  if (file.empty()) {
    return;
  }
  std::vector<FiledJointLimits> all;
  try {
    all = read_joint_limits(file, robot);
  } catch (const InputError& error) {
    robot.warnings.push_back(
        fmt::format("limits of positions in joint_limits.yaml are not kept: {}", error.what()));
    return;
  }
  for (Joint& joint : robot.joints) {
    const auto found = std::ranges::find(all, joint.name, &FiledJointLimits::joint);
    if (found == all.end() || joint.type == JointType::kFixed) {
      continue;
    }
    narrow_limits(robot, joint, found->lower, found->upper, file.filename().string());
  }
}

}  // namespace handway::geometric
