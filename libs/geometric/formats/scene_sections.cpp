#include "formats/scene_sections.h"

#include "formats/yaml_text.h"
#include "handway/geometric/formats/mesh_reader.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/robot/base_joint.h"
#include "handway/geometric/robot/inverse_kinematics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
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

namespace {

constexpr const char* kShapes = "one of box, sphere, cylinder, cone and mesh";

double size_of(const YamlElement& element) {
  const double size = element.number();
  if (size <= 0.0) {
    element.refuse(element.found(), "a size above 0 m");
  }
  return size;
}

Box box_of(const YamlElement& element) {
  element.allow_keys({"size"});
  const YamlElement size = element.need("size");
  Box box{size.numbers(3)};
  for (const YamlElement& edge : size.items()) {
    static_cast<void>(size_of(edge));
  }
  return box;
}

Eigen::Vector3d scale_of(const YamlElement& element) {
  const Eigen::Vector3d scale = element.is_list() ? Eigen::Vector3d(element.numbers(3))
                                                  : Eigen::Vector3d::Constant(element.number());
  if ((scale.array() == 0.0).any()) {
    element.refuse("a scale of 0", "one factor or three, other than 0");
  }
  return scale;
}

Mesh mesh_of(const YamlElement& element, const std::filesystem::path& folder) {
  element.allow_keys({"file", "scale"});
  const YamlElement file = element.need("file");
  const std::optional<YamlElement> scale = element.find("scale");
  Mesh mesh;
  mesh.file = find_resource(ResourceKind::kObject, file.text(), folder, file.where());
  mesh.scale = scale ? scale_of(*scale) : Eigen::Vector3d::Ones();
  mesh.triangles = read_mesh(mesh.file, mesh.scale, file.where());
  return mesh;
}

Shape shape_of(const std::string& kind, const YamlElement& element,
               const std::filesystem::path& folder) {
  if (kind == "box") {
    return box_of(element);
  }
  if (kind == "mesh") {
    return mesh_of(element, folder);
  }
  if (kind == "sphere") {
    element.allow_keys({"radius"});
    return Sphere{size_of(element.need("radius"))};
  }
  element.allow_keys({"radius", "length"});
  const double radius = size_of(element.need("radius"));
  const double length = size_of(element.need("length"));
  return kind == "cone" ? Shape(Cone{radius, length}) : Shape(Cylinder{radius, length});
}

Shape only_shape_of(const YamlElement& object, const std::filesystem::path& folder) {
  std::optional<Shape> shape;
  for (const std::string kind : {"box", "sphere", "cylinder", "cone", "mesh"}) {
    if (const std::optional<YamlElement> element = object.find(kind)) {
      if (shape) {
        element->refuse("a second shape", kShapes, "Make one object for each shape");
      }
      shape = shape_of(kind, *element, folder);
    }
  }
  if (!shape) {
    object.refuse("no shape", kShapes);
  }
  return *shape;
}

Color color_of(const YamlElement& element) {
  std::array<float, 4> parts = {0, 0, 0, 1};
  const std::vector<YamlElement> items = element.items();
  if (items.size() != 3 && items.size() != 4) {
    element.refuse(element.found(), "[red, green, blue] or [red, green, blue, opacity]");
  }
  for (std::size_t i = 0; i < items.size(); ++i) {
    const double value = items[i].number();
    if (value < 0.0 || value > 1.0) {
      items[i].refuse(items[i].found(), "a number from 0 to 1");
    }
    parts[i] = static_cast<float>(value);
  }
  return {parts[0], parts[1], parts[2], parts[3]};
}

// Resolves a link's name; links of a part of a composed robot may have their own names too.
std::string link_of(const YamlElement& element, const RobotModel& model, const RobotPart* part) {
  std::string name = element.text();
  if (part != nullptr && part->links.contains(name)) {
    return part->links.at(name);
  }
  if (!model.find_link(name)) {
    std::vector<std::string> links;
    for (const Link& link : model.description().links) {
      links.push_back(link.name);
    }
    element.refuse(element.found(), "a link of " + model.name(), advise_name(name, links));
  }
  return name;
}

Attachment attachment_of(const YamlElement& element, const Scene& scene) {
  element.allow_keys({"robot", "link", "touching"});
  Attachment attachment;
  const RobotInstance* robot = &scene.robots.front();
  const std::optional<YamlElement> name = element.find("robot");
  if (name) {
    robot = find_robot_with_part(scene, name->text());
    if (!robot) {
      name->refuse(name->found(), "a robot of the scene");
    }
  }
  const auto part = std::ranges::find(robot->parts, name ? name->text() : "", &RobotPart::name);
  const RobotPart* own = part == robot->parts.end() ? nullptr : &*part;
  attachment.robot = robot->name;
  attachment.link = link_of(element.need("link"), *robot->model, own);
  for (const YamlElement& link : element.items_of("touching")) {
    attachment.touching.push_back(link_of(link, *robot->model, own));
  }
  return attachment;
}

}  // namespace

Pose pose_of(const YamlElement& element) {
  element.allow_keys({"xyz", "rpy_deg"});
  const Eigen::Vector3d p = element.numbers_or("xyz", Eigen::Vector3d::Zero());
  const Eigen::Vector3d angles = element.numbers_or("rpy_deg", Eigen::Vector3d::Zero());
  return pose_from_rpy(p, radians(angles.x()), radians(angles.y()), radians(angles.z()));
}

std::filesystem::path find_noted(ResourceKind kind, const YamlElement& reference,
                                 const std::filesystem::path& folder, Scene& scene) {
  const std::filesystem::path file =
      find_resource(kind, reference.text(), folder, reference.where());
  if (differs_in_case(reference.text(), file)) {
    scene.warnings.push_back(reference.where() + ": the file's name has other letters, \"" +
                             file.filename().string() + "\"");
  }
  return file;
}

SceneObject object_of(const YamlElement& element, const Scene& scene,
                      const std::filesystem::path& folder) {
  element.allow_keys({"name", "box", "sphere", "cylinder", "cone", "mesh", "pose", "color",
                      "attach", "group", "hidden", "locked", "solid"});
  SceneObject object;
  object.name = element.need("name").text();
  object.shape = only_shape_of(element, folder);
  if (const std::optional<YamlElement> pose = element.find("pose")) {
    object.X_PO = pose_of(*pose);
  }
  if (const std::optional<YamlElement> color = element.find("color")) {
    object.color = color_of(*color);
  }
  if (const std::optional<YamlElement> attach = element.find("attach")) {
    object.attachment = attachment_of(*attach, scene);
  }
  object.solid = element.flag_or("solid", true);
  return object;
}

ObjectDisplay display_of(const YamlElement& element) {
  ObjectDisplay display;
  display.group = element.text_or("group", "");
  display.hidden = element.flag_or("hidden", false);
  display.locked = element.flag_or("locked", false);
  return display;
}

}  // namespace handway::geometric
