#include "formats/scene_sections.h"
#include "formats/yaml_text.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/inverse_kinematics.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

namespace handway::geometric {
namespace {

std::string moved_link_of(const YamlElement& element, const RobotModel& model) {
  std::string name = element.text();
  const std::optional<int> link = model.find_link(name);
  if (!link) {
    std::vector<std::string> links;
    std::ranges::transform(model.description().links, std::back_inserter(links), &Link::name);
    element.refuse(element.found(), "a link of " + model.name(), advise_name(name, links));
  }
  if (chain_variables(model, *link).empty()) {
    element.refuse(element.found() + ", which no joint moves", "a link that moves");
  }
  return name;
}

// Reads one number for all axes, or three.
Eigen::Vector3d tolerance_of(const YamlElement& element) {
  const Eigen::Vector3d tolerance = element.is_list() ? Eigen::Vector3d(element.numbers(3))
                                                      : Eigen::Vector3d::Constant(element.number());
  if ((tolerance.array() < 0.0).any()) {
    element.refuse(element.found(), "0 or more, one number or three");
  }
  return tolerance;
}

PoseGoal pose_goal_of(const YamlElement& element, const RobotModel& model) {
  element.allow_keys({"link", "xyz", "rpy_deg", "tool", "tolerance"});
  PoseGoal goal;
  goal.link = moved_link_of(element.need("link"), model);
  const Eigen::Vector3d xyz = element.need("xyz").numbers(3);
  const Eigen::Vector3d angles = element.numbers_or("rpy_deg", Eigen::Vector3d::Zero());
  goal.X_WG = pose_from_rpy(xyz, radians(angles.x()), radians(angles.y()), radians(angles.z()));
  if (const std::optional<YamlElement> tool = element.find("tool")) {
    goal.X_LT = pose_of(*tool);
  }
  if (const std::optional<YamlElement> tolerance = element.find("tolerance")) {
    tolerance->allow_keys({"position", "rotation_deg"});
    if (const std::optional<YamlElement> position = tolerance->find("position")) {
      goal.position_tolerance = tolerance_of(*position);
    }
    if (const std::optional<YamlElement> rotation = tolerance->find("rotation_deg")) {
      goal.rotation_tolerance = tolerance_of(*rotation) * kDegree;
    }
  }
  return goal;
}

std::string tolerance_text(const Eigen::Vector3d& tolerance) {
  const bool is_uniform = (tolerance.array() == tolerance[0]).all();
  return is_uniform ? number_text(tolerance[0]) : yaml_list(tolerance);
}

}  // namespace

std::vector<PoseGoal> pose_goals_of(const YamlElement& element, const RobotModel& model) {
  if (!element.is_list()) {
    return {pose_goal_of(element, model)};
  }
  std::vector<PoseGoal> goals;
  for (const YamlElement& one : element.items()) {
    goals.push_back(pose_goal_of(one, model));
  }
  if (goals.empty()) {
    element.refuse("an empty list", "at least one goal");
  }
  return goals;
}

std::string pose_goals_text(const std::vector<PoseGoal>& goals) {
  std::string text = goals.empty() ? "" : "goal_pose:\n";
  for (const PoseGoal& goal : goals) {
    const Eigen::Vector3d rpy = rpy_from_rotation(goal.X_WG.linear());
    const Eigen::Vector3d turns = goal.rotation_tolerance.unaryExpr(&rounded_degrees);
    text +=
        fmt::format("  - link: {}\n    xyz: {}\n    rpy_deg: {}\n", yaml_scalar(goal.link),
                    yaml_list(goal.X_WG.translation()), yaml_list(rpy.unaryExpr(&rounded_degrees)));
    if (goal.X_LT.matrix() != Eigen::Matrix4d::Identity()) {
      text += fmt::format("    tool: {}\n", yaml_pose(goal.X_LT));
    }
    text += fmt::format("    tolerance: {{position: {}, rotation_deg: {}}}\n",
                        tolerance_text(goal.position_tolerance), tolerance_text(turns));
  }
  return text;
}

}  // namespace handway::geometric
