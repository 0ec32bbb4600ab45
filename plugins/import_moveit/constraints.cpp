#include "constraints.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/inverse_kinematics.h"
#include "ros_messages.h"

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
constexpr double kSameAxes = 1e-6;  // tolerance of the cosines of axes in line

std::optional<YamlElement> only_one(const YamlElement& goal, const char* key) {
  const std::vector<YamlElement> items = goal.items_of(key);
  if (items.size() > 1) {
    goal.need(key).refuse(fmt::format("{} constraints", items.size()), "one",
                          "A goal is one pose of one link");
  }
  return items.empty() ? std::nullopt : std::optional(items.front());
}

// The frame that a constraint names: that of a link, of an object that a link holds, or of a
// subframe of one.
HeldFrame constrained_frame(const YamlElement& constraint, const RobotModel& model,
                            const HeldFrames& held) {
  const YamlElement element = constraint.need("link_name");
  const std::string name = element.text();
  const auto object = held.find(name);
  HeldFrame frame =
      object == held.end() || model.find_link(name) ? HeldFrame{name} : object->second;
  const std::optional<int> link = model.find_link(frame.link);
  if (!link) {
    std::vector<std::string> links;
    std::ranges::transform(model.description().links, std::back_inserter(links),
                           &geometric::Link::name);
    element.refuse(fmt::format("the link \"{}\"", name),
                   "a link of the robot, or an object that it holds",
                   geometric::advise_name(name, links));
  }
  if (chain_variables(model, *link).empty()) {
    element.refuse(fmt::format("the link \"{}\", which no joint of the group moves", frame.link),
                   "a link that moves");
  }
  return frame;
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

// Returns the tolerance along the goal's axes. @param R_GQ of the region in the goal.
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

Eigen::Matrix3d rotation_of(const YamlElement& constraint, const Frames& frames) {
  constraint.refuse_slips({"header", "orientation", "link_name", "absolute_x_axis_tolerance",
                           "absolute_y_axis_tolerance", "absolute_z_axis_tolerance",
                           "parameterization", "weight"});
  return frame_of(constraint, frames).linear() *
         read_rotation(constraint.need("orientation")).toRotationMatrix();
}

// Rotations about x, y and z, rad.
Eigen::Vector3d rotation_tolerance(const YamlElement& constraint) {
  Eigen::Vector3d tolerances = Eigen::Vector3d::Zero();
  Eigen::Index axis = 0;
  for (const char* key :
       {"absolute_x_axis_tolerance", "absolute_y_axis_tolerance", "absolute_z_axis_tolerance"}) {
    const std::optional<YamlElement> element = constraint.find(key);
    const double tolerance = element ? element->number() : 0.0;
    if (tolerance < 0.0) {
      element->refuse(element->found(), "0 rad or more");
    }
    tolerances[axis++] = tolerance;
  }
  return tolerances;
}

struct Primitive {
  geometric::Shape shape;
  Pose X_WQ;
};

// At least one.
std::vector<Primitive> region_of(const YamlElement& constraint, const Frames& frames) {
  constraint.refuse_slips(
      {"header", "link_name", "target_point_offset", "constraint_region", "weight"});
  const YamlElement region = constraint.need("constraint_region");
  if (const auto meshes = region.find("meshes"); meshes && !meshes->items().empty()) {
    meshes->refuse("a mesh", "primitives");
  }
  const Pose X_WF = frame_of(constraint, frames);
  std::vector<Primitive> primitives;
  for (const auto& [shape, X_FQ] : read_primitives(region)) {
    primitives.push_back({shape, X_WF * X_FQ});
  }
  if (primitives.empty()) {
    region.refuse("no primitives", "at least one");
  }
  return primitives;
}

// Returns the point of the link that the constraint positions.
Eigen::Vector3d target_point(const YamlElement& constraint) {
  const auto offset = constraint.find("target_point_offset");
  return offset ? read_point(*offset) : Eigen::Vector3d::Zero();
}

// A goal for each primitive of the region. @param base with the orientation, if any.
std::vector<PoseGoal> with_positions(const YamlElement& constraint, const Frames& frames,
                                     const PoseGoal& base, bool has_orientation) {
  std::vector<PoseGoal> goals;
  for (const auto& [shape, X_WQ] : region_of(constraint, frames)) {
    PoseGoal goal = base;
    goal.X_WG.translation() = X_WQ.translation();
    if (!has_orientation) {
      goal.X_WG.linear() = X_WQ.linear();
    }
    goal.position_tolerance = tolerance_of(constraint.need("constraint_region"), shape,
                                           goal.X_WG.linear().transpose() * X_WQ.linear());
    goal.X_LT.translation() = base.X_LT * target_point(constraint);
    goals.push_back(std::move(goal));
  }
  return goals;
}

// A link whose frame is used as a frame of the world must not move along the path.
void need_fixed_frame(const YamlElement& constraint, const RobotModel& model) {
  const std::optional<std::string> frame = frame_name(constraint);
  const std::optional<int> link = frame ? model.find_link(*frame) : std::nullopt;
  if (link && !chain_variables(model, *link).empty()) {
    constraint.need("header")
        .need("frame_id")
        .refuse(fmt::format("the frame of \"{}\", which moves", *frame),
                "a frame that stays where it is along the path");
  }
}

constexpr double kFree = 3.14;  // rad: as people write π

/// Cone: an axis of a link stays near its target.
struct Cone {
  Eigen::Index axis;  ///< 0: x.
  double angle;       ///< rad
};

// Cones inside of tolerances of the angles a, b, c of R = Rx(a) Ry(b) Rz(c): cos a cos b is the
// cosine of z's deviation, cos b cos c that of x; up to a right angle neither deviation is less
// than its angles.
std::vector<Cone> cones_of_angles(const Eigen::Vector3d& tolerance) {
  return {{2, std::min(tolerance.x(), tolerance.y())}, {0, tolerance.z()}};
}

// Inside of a tolerance of the whole rotation: with z and x both off by α, its cosine is at least
// 2 cos α - 1.
std::vector<Cone> cones_of_rotation(double tolerance) {
  const double angle = std::acos(0.5 * (1.0 + std::cos(tolerance)));
  return {{2, angle}, {0, angle}};
}

std::vector<Cone> cones_within(const YamlElement& constraint) {
  const Eigen::Vector3d tolerance = rotation_tolerance(constraint);
  const auto parameterization = constraint.find("parameterization");
  const bool is_rotation_vector = parameterization && parameterization->number() == 1.0;
  if (tolerance.minCoeff() <= 0.0) {
    constraint.refuse("a tolerance of 0", "tolerances above 0 rad along the path");
  }
  Eigen::Index free = 0;
  switch ((tolerance.array() >= kFree).count()) {
    case 0:
      return is_rotation_vector ? cones_of_rotation(tolerance.minCoeff())
                                : cones_of_angles(tolerance);
    case 1: {
      tolerance.maxCoeff(&free);
      const double least = tolerance.minCoeff();
      // The farthest rotation vector is half a turn about an axis off by α/2.
      return {{free, is_rotation_vector ? 2.0 * std::asin(least / std::numbers::pi) : least}};
    }
    case 2:
      constraint.refuse("a link that is free about two axes", "about one, about all or about none",
                        "Give a tolerance below 3.14 for one more axis");
    default:
      return {};
  }
}

// Returns the link's orientation constraints, one for each cone.
std::vector<geometric::OrientationConstraint> orientations_of(const YamlElement& constraint,
                                                              const Frames& frames) {
  constexpr double kRightAngle = 0.5 * std::numbers::pi;
  const Eigen::Matrix3d R_WG = rotation_of(constraint, frames);
  std::vector<geometric::OrientationConstraint> orientations;
  for (const Cone& cone : cones_within(constraint)) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(cone.axis);
    orientations.push_back({axis, R_WG * axis, std::min(cone.angle, kRightAngle)});
  }
  return orientations;
}

geometric::PositionConstraint position_of(const YamlElement& constraint, const Frames& frames) {
  const std::vector<Primitive> region = region_of(constraint, frames);
  const YamlElement element = constraint.need("constraint_region");
  if (region.size() > 1) {
    element.refuse(fmt::format("{} primitives", region.size()), "one along the path");
  }
  const auto& [shape, X_WQ] = region.front();
  return {target_point(constraint), 2.0 * tolerance_of(element, shape, Eigen::Matrix3d::Identity()),
          X_WQ};
}

}  // namespace

bool has_pose(const YamlElement& goal) {
  return !goal.items_of("position_constraints").empty() ||
         !goal.items_of("orientation_constraints").empty();
}

std::vector<PoseGoal> read_pose_goals(const YamlElement& goal, const RobotModel& model,
                                      const Frames& frames, const HeldFrames& held) {
  const std::optional<YamlElement> position = only_one(goal, "position_constraints");
  const std::optional<YamlElement> orientation = only_one(goal, "orientation_constraints");
  PoseGoal pose;
  pose.position_tolerance.setConstant(kAnywhere);
  pose.rotation_tolerance.setConstant(std::numbers::pi);
  if (orientation) {
    const HeldFrame frame = constrained_frame(*orientation, model, held);
    pose.link = frame.link;
    pose.X_LT = frame.X_LF;
    pose.X_WG.linear() = rotation_of(*orientation, frames);
    pose.rotation_tolerance = rotation_tolerance(*orientation);
  }
  if (!position) {
    return {pose};
  }
  const HeldFrame frame = constrained_frame(*position, model, held);
  const std::string name = position->need("link_name").text();
  if (orientation && name != orientation->need("link_name").text()) {
    position->need("link_name")
        .refuse(fmt::format("the link \"{}\"", name),
                fmt::format("\"{}\", as of the orientation constraint",
                            orientation->need("link_name").text()),
                "A goal is one pose of one link");
  }
  pose.link = frame.link;
  pose.X_LT = frame.X_LF;
  return with_positions(*position, frames, pose, orientation.has_value());
}

std::vector<geometric::PathConstraint> read_path_constraints(const YamlElement& path,
                                                             const RobotModel& model,
                                                             const Frames& frames,
                                                             const HeldFrames& held) {
  path.refuse_slips({"name", "joint_constraints", "position_constraints", "orientation_constraints",
                     "visibility_constraints"});
  for (const char* key : {"joint_constraints", "visibility_constraints"}) {
    if (!path.items_of(key).empty()) {
      path.need(key).refuse("constraints along the path that are not planned with",
                            "position and orientation constraints");
    }
  }
  std::vector<geometric::PathConstraint> all;
  const auto add = [&](const std::string& link, const std::string& what, const auto& constraint) {
    const std::string first = fmt::format("{} of {}", what, link);
    std::string name = first;
    for (int n = 2; std::ranges::count(all, name, &geometric::PathConstraint::name) > 0; ++n) {
      name = fmt::format("{} {}", first, n);
    }
    all.push_back({name, link, constraint});
  };
  for (const YamlElement& constraint : path.items_of("orientation_constraints")) {
    need_fixed_frame(constraint, model);
    const HeldFrame frame = constrained_frame(constraint, model, held);
    for (geometric::OrientationConstraint one : orientations_of(constraint, frames)) {
      one.axis = frame.X_LF.linear() * one.axis;
      add(frame.link, "orientation", one);
    }
  }
  for (const YamlElement& constraint : path.items_of("position_constraints")) {
    need_fixed_frame(constraint, model);
    const HeldFrame frame = constrained_frame(constraint, model, held);
    geometric::PositionConstraint one = position_of(constraint, frames);
    one.point = frame.X_LF * one.point;
    add(frame.link, "position", one);
  }
  return all;
}

}  // namespace handway::import_moveit
