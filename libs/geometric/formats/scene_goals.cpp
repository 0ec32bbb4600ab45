#include "formats/scene_sections.h"
#include "formats/yaml_text.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/inverse_kinematics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

// Reads the tool of a goal: a pose, or the name of a frame on the goal's link.
void read_tool(const YamlElement& element, const Scene& scene, std::vector<std::string>* warnings,
               PoseGoal& goal) {
  if (!element.is_scalar()) {
    goal.X_LT = pose_of(element);
    return;
  }
  goal.tool = element.text();
  const NamedFrame* frame = find_frame(scene, goal.tool);
  if (frame && frame->parent == goal.link) {
    goal.X_LT = frame->X_PF;
  } else if (warnings) {
    warnings->push_back(
        fmt::format("{}: link {} has no frame \"{}\"", element.where(), goal.link, goal.tool));
  } else {
    std::vector<std::string> names;
    for (const NamedFrame& other : scene.frames) {
      if (other.parent == goal.link) {
        names.push_back(other.name);
      }
    }
    element.refuse(element.found(), "a pose, or a frame on the link " + goal.link,
                   advise_name(goal.tool, names));
  }
}

std::string tolerance_text(const Eigen::Vector3d& tolerance) {
  const bool is_uniform = (tolerance.array() == tolerance[0]).all();
  return is_uniform ? number_text(tolerance[0]) : yaml_list(tolerance);
}

// Without the last digits of the translation, which computing it has changed.
Pose rounded(Pose X) {
  constexpr double kSteps = 1e12;  // per metre
  X.translation() = (kSteps * X.translation()).array().round() / kSteps;
  return X;
}

}  // namespace

std::string standing_name_of(const YamlElement& element, const Scene& scene,
                             std::vector<std::string>* warnings) {
  std::string name = element.text();
  if (standing_pose(scene, name)) {
    return name;
  }
  const SceneObject* object = find_object(scene, name);
  const NamedFrame* frame = find_frame(scene, name);
  if (!object && !frame && warnings) {
    warnings->push_back(fmt::format("{}: the scene has no object \"{}\"", element.where(), name));
    return name;
  }
  element.refuse(element.found() + (object || frame ? ", which is attached to a link" : ""),
                 "an object or a frame that stands in the world",
                 advise_name(name, standing_names(scene)));
}

PoseGoal relative_goal_of(const YamlElement& element, const Scene& scene,
                          std::vector<std::string>* warnings) {
  element.allow_keys({"link", "in", "xyz", "rpy_deg", "tool", "tolerance"});
  PoseGoal goal;
  goal.link = moved_link_of(element.need("link"), *scene.robots.front().model);
  const Eigen::Vector3d xyz = element.need("xyz").numbers(3);
  const Eigen::Vector3d angles = element.numbers_or("rpy_deg", Eigen::Vector3d::Zero());
  goal.X_WG = pose_from_rpy(xyz, radians(angles.x()), radians(angles.y()), radians(angles.z()));
  if (const std::optional<YamlElement> in = element.find("in")) {
    goal.reference = standing_name_of(*in, scene, warnings);
  }
  if (const std::optional<YamlElement> tool = element.find("tool")) {
    read_tool(*tool, scene, warnings, goal);
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

std::vector<std::string> goal_entries(const PoseGoal& goal, const Pose& X) {
  std::vector<std::string> entries{fmt::format("link: {}", yaml_scalar(goal.link))};
  if (!goal.reference.empty()) {
    entries.push_back(fmt::format("in: {}", yaml_scalar(goal.reference)));
  }
  const Eigen::Vector3d rpy = rpy_from_rotation(X.linear());
  entries.push_back(fmt::format("xyz: {}", yaml_list(X.translation())));
  entries.push_back(fmt::format("rpy_deg: {}", yaml_list(rpy.unaryExpr(&rounded_degrees))));
  if (!goal.tool.empty()) {
    entries.push_back(fmt::format("tool: {}", yaml_scalar(goal.tool)));
  } else if (goal.X_LT.matrix() != Eigen::Matrix4d::Identity()) {
    entries.push_back(fmt::format("tool: {}", yaml_pose(goal.X_LT)));
  }
  const Eigen::Vector3d turns = goal.rotation_tolerance.unaryExpr(&rounded_degrees);
  entries.push_back(fmt::format("tolerance: {{position: {}, rotation_deg: {}}}",
                                tolerance_text(goal.position_tolerance), tolerance_text(turns)));
  return entries;
}

std::vector<PoseGoal> pose_goals_of(const YamlElement& element, const Scene& scene) {
  const auto goal_of = [&](const YamlElement& one) {
    PoseGoal goal = relative_goal_of(one, scene, nullptr);
    goal.X_WG = standing_pose(scene, goal.reference).value_or(Pose::Identity()) * goal.X_WG;
    return goal;
  };
  if (!element.is_list()) {
    return {goal_of(element)};
  }
  std::vector<PoseGoal> goals;
  for (const YamlElement& one : element.items()) {
    goals.push_back(goal_of(one));
  }
  if (goals.empty()) {
    element.refuse("an empty list", "at least one goal");
  }
  return goals;
}

std::string pose_goals_text(const Scene& scene) {
  std::string text = scene.goal_poses.empty() ? "" : "goal_pose:\n";
  for (const PoseGoal& goal : scene.goal_poses) {
    const std::optional<Pose> reference = standing_pose(scene, goal.reference);
    const Pose X = reference ? rounded(reference->inverse() * goal.X_WG) : goal.X_WG;
    text += fmt::format("  - {}\n", fmt::join(goal_entries(goal, X), "\n    "));
  }
  return text;
}

NamedFrame frame_of(const YamlElement& element, const Scene& scene) {
  element.allow_keys({"name", "on", "pose"});
  NamedFrame frame;
  frame.name = element.need("name").text();
  if (const std::optional<YamlElement> on = element.find("on")) {
    frame.parent = on->text();
    if (!find_object(scene, frame.parent) && !scene.robots.front().model->find_link(frame.parent)) {
      on->refuse(on->found(), "an object, or a link of " + scene.robots.front().name,
                 advise_name(frame.parent, constrainable_bodies(scene)));
    }
  }
  if (const std::optional<YamlElement> pose = element.find("pose")) {
    frame.X_PF = pose_of(*pose);
  }
  return frame;
}

std::string frames_text(const std::vector<NamedFrame>& frames) {
  std::string text = frames.empty() ? "" : "frames:\n";
  for (const NamedFrame& frame : frames) {
    const std::string on =
        frame.parent.empty() ? "" : fmt::format("on: {}, ", yaml_scalar(frame.parent));
    text += fmt::format("  - {{name: {}, {}pose: {}}}\n", yaml_scalar(frame.name), on,
                        yaml_pose(frame.X_PF));
  }
  return text;
}

}  // namespace handway::geometric
