#include "goal_constraints.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/inverse_kinematics.h"
#include "problem_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace handway::import_moveit {
namespace {

using geometric::Pose;
using geometric::PoseGoal;
using geometric::RobotModel;
using geometric::YamlElement;

constexpr double kAnywhere = 1e3;   // m
constexpr double kSameAxes = 1e-6;  // of the cosines of axes in line

std::optional<YamlElement> only_one(const YamlElement& goal, const char* key) {
  const std::vector<YamlElement> items = items_of(goal, key);
  if (items.size() > 1) {
    goal.need(key).refuse(fmt::format("{} constraints", items.size()), "one",
                          "A goal is one pose of one link");
  }
  return items.empty() ? std::nullopt : std::optional(items.front());
}

std::string moved_link(const YamlElement& constraint, const RobotModel& model) {
  const YamlElement element = constraint.need("link_name");
  std::string name = element.text();
  const std::optional<int> link = model.find_link(name);
  if (!link) {
    std::vector<std::string> links;
    std::ranges::transform(model.description().links, std::back_inserter(links),
                           &geometric::Link::name);
    element.refuse(fmt::format("the link \"{}\"", name), "a link of the robot",
                   geometric::advise_name(name, links));
  }
  if (chain_variables(model, *link).empty()) {
    element.refuse(fmt::format("the link \"{}\", which no joint of the group moves", name),
                   "a link that moves");
  }
  return name;
}

// Half sides of the largest box along the region's axes that is inside.
Eigen::Vector3d half_sides(const YamlElement& element, const geometric::Shape& shape) {
  if (const auto* box = std::get_if<geometric::Box>(&shape)) {
    return 0.5 * box->size;
  }
  if (const auto* cylinder = std::get_if<geometric::Cylinder>(&shape)) {
    const double side = cylinder->radius / std::numbers::sqrt2;
    return {side, side, 0.5 * cylinder->length};
  }
  element.refuse("a cone", "a box, a sphere or a cylinder");
}

// The same along the goal's axes. @param R_GQ of the region in the goal.
Eigen::Vector3d tolerance_of(const YamlElement& element, const geometric::Shape& shape,
                             const Eigen::Matrix3d& R_GQ) {
  if (const auto* sphere = std::get_if<geometric::Sphere>(&shape)) {
    return Eigen::Vector3d::Constant(sphere->radius / std::numbers::sqrt3);
  }
  const Eigen::Vector3d half = half_sides(element, shape);
  const Eigen::Matrix3d cosines = R_GQ.cwiseAbs();
  if ((cosines.array() < kSameAxes || cosines.array() > 1.0 - kSameAxes).all()) {
    return cosines * half;  // the axes swapped
  }
  return Eigen::Vector3d::Constant(half.minCoeff() / std::numbers::sqrt3);
}

void read_orientation(const YamlElement& constraint, const Frames& frames, PoseGoal& goal) {
  constraint.refuse_slips({"header", "orientation", "link_name", "absolute_x_axis_tolerance",
                           "absolute_y_axis_tolerance", "absolute_z_axis_tolerance",
                           "parameterization", "weight"});
  goal.X_WG.linear() = frame_of(constraint, frames).linear() *
                       read_rotation(constraint.need("orientation")).toRotationMatrix();
  Eigen::Index axis = 0;
  for (const char* key :
       {"absolute_x_axis_tolerance", "absolute_y_axis_tolerance", "absolute_z_axis_tolerance"}) {
    const std::optional<YamlElement> element = constraint.find(key);
    const double tolerance = element ? element->number() : 0.0;
    if (tolerance < 0.0) {
      element->refuse(element->found(), "0 rad or more");
    }
    goal.rotation_tolerance[axis++] = tolerance;
  }
}

// A goal for each primitive of the region. @param base with the orientation, if there is one.
std::vector<PoseGoal> with_positions(const YamlElement& constraint, const Frames& frames,
                                     const PoseGoal& base, bool has_orientation) {
  constraint.refuse_slips(
      {"header", "link_name", "target_point_offset", "constraint_region", "weight"});
  const YamlElement region = constraint.need("constraint_region");
  if (const auto meshes = region.find("meshes"); meshes && !meshes->items().empty()) {
    meshes->refuse("a mesh", "primitives");
  }
  const Pose X_WF = frame_of(constraint, frames);
  std::vector<PoseGoal> goals;
  for (const auto& [shape, X_FQ] : read_primitives(region)) {
    PoseGoal goal = base;
    const Pose X_WQ = X_WF * X_FQ;
    goal.X_WG.translation() = X_WQ.translation();
    if (!has_orientation) {
      goal.X_WG.linear() = X_WQ.linear();
    }
    goal.position_tolerance =
        tolerance_of(region, shape, goal.X_WG.linear().transpose() * X_WQ.linear());
    if (const auto offset = constraint.find("target_point_offset")) {
      goal.X_LT.translation() = read_point(*offset);
    }
    goals.push_back(std::move(goal));
  }
  if (goals.empty()) {
    region.refuse("no primitives", "at least one");
  }
  return goals;
}

}  // namespace

bool has_pose(const YamlElement& goal) {
  return !items_of(goal, "position_constraints").empty() ||
         !items_of(goal, "orientation_constraints").empty();
}

std::vector<PoseGoal> read_pose_goals(const YamlElement& goal, const RobotModel& model,
                                      const Frames& frames) {
  const std::optional<YamlElement> position = only_one(goal, "position_constraints");
  const std::optional<YamlElement> orientation = only_one(goal, "orientation_constraints");
  PoseGoal pose;
  pose.position_tolerance.setConstant(kAnywhere);
  pose.rotation_tolerance.setConstant(std::numbers::pi);
  if (orientation) {
    pose.link = moved_link(*orientation, model);
    read_orientation(*orientation, frames, pose);
  }
  if (!position) {
    return {pose};
  }
  const std::string link = moved_link(*position, model);
  if (orientation && link != pose.link) {
    position->need("link_name")
        .refuse(fmt::format("the link \"{}\"", link),
                fmt::format("\"{}\", as of the orientation constraint", pose.link),
                "A goal is one pose of one link");
  }
  pose.link = link;
  return with_positions(*position, frames, pose, orientation.has_value());
}

}  // namespace handway::import_moveit
