#include "formats/scene_sections.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/robot/base_joint.h"
#include "handway/geometric/robot/inverse_kinematics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

constexpr double kAroundScene = 0.5;  // m, that a base may go beyond what is in the scene
constexpr double kRounding = 100.0;   // steps of bounds per metre

using Points = std::vector<Eigen::Vector3d>;

std::vector<std::string> slides_of_bases(const RobotModel& model) {
  std::vector<std::string> names;
  for (const BaseJoint& base : model.description().base_joints) {
    const std::vector<std::string> slides = slides_of(base);
    names.insert(names.end(), slides.begin(), slides.end());
  }
  return names;
}

/// Lower and upper bound by name of the slide, m.
using Bounds = std::map<std::string, std::pair<double, double>>;

Bounds given_bounds(const YamlElement& robot, const RobotModel& model) {
  const std::vector<std::string> slides = slides_of_bases(model);
  Bounds bounds;
  const std::optional<YamlElement> element = robot.find("bounds");
  for (const auto& [name, value] :
       element ? element->entries() : std::vector<std::pair<std::string, YamlElement>>()) {
    if (std::ranges::count(slides, name) == 0) {
      value.refuse("bounds for \"" + name + "\"",
                   slides.empty()
                       ? "none: the robot's base does not move"
                       : fmt::format("a slide of a moving base: {}", fmt::join(slides, ", ")),
                   slides.empty() ? "Let it move by moving_base: planar, or floating"
                                  : advise_name(name, slides));
    }
    const Eigen::VectorXd ends = value.numbers(2);
    if (!(ends[0] < ends[1])) {
      value.refuse(fmt::format("{:g} to {:g}", ends[0], ends[1]), "two numbers, the lower first");
    }
    bounds[name] = {ends[0], ends[1]};
  }
  return bounds;
}

std::shared_ptr<const RobotModel> bounded(const RobotModel& model, const Bounds& bounds) {
  RobotDescription description = model.description();
  for (Joint& joint : description.joints) {
    if (const auto found = bounds.find(joint.name); found != bounds.end()) {
      joint.limits.lower = found->second.first;
      joint.limits.upper = found->second.second;
    }
  }
  return std::make_shared<const RobotModel>(std::move(description));
}

BaseJoint chosen_base(const YamlElement& element, const RobotDescription& robot) {
  const std::string motion = element.text();
  if (motion != "planar" && motion != "floating") {
    element.refuse("\"" + motion + "\"", "planar or floating");
  }
  BaseJoint base{"base", motion == "planar" ? BaseMotion::kPlanar : BaseMotion::kFloating, true};
  const auto named = std::ranges::find(robot.virtual_joints, base.motion, &BaseJoint::motion);
  if (named != robot.virtual_joints.end()) {
    base.name = named->name;
  }
  return base;
}

void add_corners(const Shape& shape, const Pose& X, Points& points) {
  const auto mesh = tessellate(shape);
  if (!mesh || mesh->vertices.empty()) {
    return;
  }
  const Aabb box = bounding_box(*mesh);
  for (int corner = 0; corner < 8; ++corner) {
    points.emplace_back(X * Eigen::Vector3d((corner & 1) != 0 ? box.upper.x() : box.lower.x(),
                                            (corner & 2) != 0 ? box.upper.y() : box.lower.y(),
                                            (corner & 4) != 0 ? box.upper.z() : box.lower.z()));
  }
}

void add_robot(const RobotInstance& robot, const Configuration& q, Points& points) {
  std::vector<Pose> X_BL(static_cast<std::size_t>(robot.model->link_count()));
  robot.model->forward_kinematics(q, X_BL);
  for (int i = 0; i < robot.model->link_count(); ++i) {
    const Pose X_WL = robot.X_WB * X_BL[static_cast<std::size_t>(i)];
    for (const auto& part : robot.model->link(i).collision) {
      add_corners(part.shape, X_WL * part.X_LG, points);
    }
  }
}

// Corners in the world of all bodies in the scene.
Points corners_of(const Scene& scene) {
  Points points;
  for (const SceneObject& object : scene.objects) {
    if (!object.attachment) {
      add_corners(object.shape, object.X_PO, points);
    }
  }
  for (const RobotInstance& robot : scene.robots) {
    add_robot(robot, robot.configuration, points);
  }
  for (const auto& q : {scene.start, scene.goal}) {
    if (q) {
      add_robot(scene.robots.front(), *q, points);
    }
  }
  for (const PoseGoal& goal : scene.goal_poses) {
    points.push_back(goal.X_WG.translation());
  }
  return points;
}

// Adds bounds of `base`'s slides that `bounds` lack, around `points` and the robot's own values.
void add_bounds(const RobotInstance& robot, const BaseJoint& base, const Points& points,
                const std::vector<Configuration>& values, Bounds& bounds) {
  const RobotModel& model = *robot.model;
  std::vector<Pose> X_BL(static_cast<std::size_t>(model.link_count()));
  model.forward_kinematics(robot.configuration, X_BL);
  std::optional<Pose> X_WJ;  // of the first slide's frame
  for (const std::string& slide : slides_of(base)) {
    const int variable = model.find_variable(slide).value();
    const int link = model.variable_link(variable);
    if (!X_WJ) {
      X_WJ =
          robot.X_WB * X_BL[static_cast<std::size_t>(model.parent(link))] * model.joint(link).X_PJ;
    }
    double lower = robot.configuration[variable];
    double upper = lower;
    const auto include = [&](double value) {
      lower = std::min(lower, value);
      upper = std::max(upper, value);
    };
    for (const Eigen::Vector3d& point : points) {
      include(model.joint(link).axis.dot(X_WJ->inverse() * point));
    }
    for (const Configuration& q : values) {
      include(q[variable]);
    }
    bounds.emplace(slide, std::pair(std::floor(kRounding * (lower - kAroundScene)) / kRounding,
                                    std::ceil(kRounding * (upper + kAroundScene)) / kRounding));
  }
}

}  // namespace

std::shared_ptr<const RobotModel> with_bases(const YamlElement& robot,
                                             const std::shared_ptr<const RobotModel>& model) {
  std::shared_ptr<const RobotModel> moving = model;
  if (const std::optional<YamlElement> element = robot.find("moving_base")) {
    RobotDescription description = model->description();
    add_moving_root(description, chosen_base(*element, description), model->link(0).name, "world");
    moving = std::make_shared<const RobotModel>(std::move(description));
  }
  const Bounds bounds = given_bounds(robot, *moving);
  return bounds.empty() ? moving : bounded(*moving, bounds);
}

void bound_bases(const std::vector<YamlElement>& robots, Scene& scene) {
  Points points;
  for (std::size_t i = 0; i < scene.robots.size(); ++i) {
    RobotInstance& robot = scene.robots[i];
    Bounds bounds = given_bounds(robots[i], *robot.model);
    if (bounds.size() == slides_of_bases(*robot.model).size()) {
      continue;
    }
    if (points.empty()) {
      points = corners_of(scene);
    }
    std::vector<Configuration> values;
    for (const auto& q : {scene.start, scene.goal}) {
      if (q && i == 0) {
        values.push_back(*q);
      }
    }
    for (const BaseJoint& base : robot.model->description().base_joints) {
      add_bounds(robot, base, points, values, bounds);
    }
    robot.model = bounded(*robot.model, bounds);
    if (!robot.parts.empty()) {
      robot.parts.front().model = bounded(*robot.parts.front().model, bounds);
    }
  }
}

}  // namespace handway::geometric
