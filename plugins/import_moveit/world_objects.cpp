#include "world_objects.h"

#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/formats/mesh_reader.h"
#include "handway/geometric/io/existing_file.h"
#include "octomap_mesh.h"
#include "problem_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace handway::import_moveit {
namespace {

namespace fs = std::filesystem;
using geometric::Pose;
using geometric::Shape;
using geometric::YamlElement;

constexpr geometric::Color kColor{0.55, 0.62, 0.68};
constexpr double kSmallestNormal = 1e-9;
constexpr double kOnPlane = 1e-6;  // m

// shape_msgs/SolidPrimitive's numbers, and the words of MotionBenchMaker.
std::string kind_of(const YamlElement& type) {
  static const std::map<std::string, std::string> kKinds = {
      {"1", "box"}, {"2", "sphere"}, {"3", "cylinder"}, {"4", "cone"}};
  const auto kind = kKinds.find(type.text());
  return kind == kKinds.end() ? type.text() : kind->second;
}

Shape read_primitive(const YamlElement& primitive) {
  const YamlElement type = primitive.need("type");
  const YamlElement list = primitive.need("dimensions");
  const std::string kind = kind_of(type);
  const auto sizes = [&](int count) {
    const Eigen::VectorXd values = list.numbers(count);
    if ((values.array() <= 0.0).any()) {
      list.refuse("a size that is not above 0", "sizes in metres");
    }
    return values;
  };
  if (kind == "box") {
    return geometric::Box{sizes(3)};
  }
  if (kind == "sphere") {
    return geometric::Sphere{sizes(1)[0]};
  }
  if (kind == "cylinder" || kind == "cone") {
    const Eigen::VectorXd size = sizes(2);  // height, radius
    return kind == "cone" ? Shape(geometric::Cone{size[1], size[0]})
                          : Shape(geometric::Cylinder{size[1], size[0]});
  }
  type.refuse(type.found(), "box (1), sphere (2), cylinder (3) or cone (4)");
}

std::array<std::uint32_t, 3> read_triangle(const YamlElement& element, std::size_t vertices) {
  const YamlElement list = element.is_map() ? element.need("vertex_indices") : element;
  const Eigen::VectorXd values = list.numbers(3);
  std::array<std::uint32_t, 3> triangle{};
  for (std::size_t i = 0; i < triangle.size(); ++i) {
    const double index = values[static_cast<Eigen::Index>(i)];
    if (index < 0.0 || index >= static_cast<double>(vertices) || index != std::floor(index)) {
      list.refuse(fmt::format("the vertex {:g}", index),
                  fmt::format("one of the {} vertices, from 0", vertices));
    }
    triangle.at(i) = static_cast<std::uint32_t>(index);
  }
  return triangle;
}

Shape read_mesh_shape(const YamlElement& element, const fs::path& folder,
                      std::vector<std::string>& warnings) {
  if (const auto resource = element.find("resource")) {
    geometric::Mesh mesh;
    mesh.file = mesh_file(*resource, folder);
    if (geometric::differs_in_case(resource->text(), mesh.file)) {
      warnings.push_back(fmt::format("{}: the file's name has other letters, \"{}\"",
                                     resource->where(), mesh.file.filename().string()));
    }
    if (const auto scale = element.find("dimensions")) {
      mesh.scale = scale->numbers(3);
    }
    mesh.triangles = geometric::read_mesh(mesh.file, mesh.scale, resource->where());
    return mesh;
  }
  auto triangles = std::make_shared<geometric::TriangleMesh>();
  for (const YamlElement& vertex : element.need("vertices").items()) {
    triangles->vertices.push_back(read_point(vertex));
  }
  const YamlElement list = element.need("triangles");
  for (const YamlElement& triangle : list.items()) {
    triangles->triangles.push_back(read_triangle(triangle, triangles->vertices.size()));
  }
  if (triangles->empty()) {
    list.refuse("an empty list", "at least one triangle");
  }
  return geometric::Mesh{{}, Eigen::Vector3d::Ones(), std::move(triangles)};
}

using PlacedShape = std::pair<Shape, Pose>;

// The shapes under `key` with their poses under `poses`, in the object's frame.
template <typename Read, typename Placed>
void read_shapes(const YamlElement& object, const char* key, const char* poses, const Read& read,
                 std::vector<Placed>& shapes) {
  const std::optional<YamlElement> list = object.find(key);
  const std::vector<YamlElement> items = list ? list->items() : std::vector<YamlElement>();
  const std::optional<YamlElement> pose_list = object.find(poses);
  const std::vector<YamlElement> placed =
      pose_list ? pose_list->items() : std::vector<YamlElement>();
  if (!placed.empty() && placed.size() != items.size()) {
    pose_list->refuse(fmt::format("{} poses", placed.size()),
                      fmt::format("{}, one for each of {}", items.size(), key));
  }
  for (std::size_t i = 0; i < items.size(); ++i) {
    shapes.emplace_back(read(items[i]), placed.empty() ? Pose::Identity() : read_pose(placed[i]));
  }
}

// The plane ax + by + cz + d = 0 as a box on that side of it that the robot's base is not on.
// @param X_WF of the frame of its numbers.
PlacedShape half_space(const YamlElement& plane, const Pose& X_WF, const Reach& reach) {
  const YamlElement list = plane.is_map() ? plane.need("coef") : plane;
  const Eigen::Vector4d values = list.numbers(4);
  const double length = values.head<3>().norm();
  if (length < kSmallestNormal) {
    list.refuse("a plane without direction", "a, b, c, d of ax + by + cz + d = 0");
  }
  Eigen::Vector3d normal = values.head<3>() / length;
  double height = normal.dot(X_WF.inverse() * reach.centre) + values[3] / length;
  if (height < -kOnPlane) {
    normal = -normal;
    height = -height;
  }
  const double side = 2.0 * reach.radius;
  Pose X_FB = Pose::Identity();
  X_FB.linear() =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal).toRotationMatrix();
  X_FB.translation() = X_WF.inverse() * reach.centre - (height + 0.5 * side) * normal;
  return {geometric::Box{Eigen::Vector3d::Constant(side)}, X_FB};
}

std::vector<PlacedShape> shapes_of(const YamlElement& object, const Pose& X_WO, World& world) {
  std::vector<PlacedShape> shapes;
  read_shapes(object, "primitives", "primitive_poses", read_primitive, shapes);
  read_shapes(
      object, "meshes", "mesh_poses",
      [&](const YamlElement& mesh) {
        return read_mesh_shape(mesh, world.folder, world.scene.warnings);
      },
      shapes);
  std::vector<std::pair<YamlElement, Pose>> planes;
  read_shapes(
      object, "planes", "plane_poses", [](const YamlElement& plane) { return plane; }, planes);
  for (const auto& [plane, X_OP] : planes) {
    auto [shape, X_PB] = half_space(plane, X_WO * X_OP, world.reach);
    shapes.emplace_back(std::move(shape), X_OP * X_PB);
  }
  if (shapes.empty()) {
    object.refuse("no primitives, meshes or planes", "at least one of them");
  }
  return shapes;
}

std::string unique_name(const geometric::Scene& scene, const std::string& wanted) {
  std::string name = wanted;
  for (int n = 2; find_object(scene, name) != nullptr || find_robot(scene, name) != nullptr; ++n) {
    name = fmt::format("{}_{}", wanted, n);
  }
  return name;
}

// @param X_PF of the object's frame in what it is fixed to. @param X_WP of that in the world.
void add_object(const YamlElement& object, const Pose& X_PF, const Pose& X_WP,
                const std::optional<geometric::Attachment>& attachment, World& world) {
  object.refuse_slips({"header", "id", "type", "pose", "primitives", "primitive_poses", "meshes",
                       "mesh_poses", "planes", "plane_poses", "subframe_names", "subframe_poses",
                       "operation"});
  const std::optional<YamlElement> pose = object.find("pose");
  const Pose X_PO = pose ? X_PF * read_pose(*pose) : X_PF;
  const std::string id = object.need("id").text();
  for (auto& [shape, X_OS] : shapes_of(object, X_WP * X_PO, world)) {
    const std::string name = unique_name(world.scene, id);
    world.names[id].push_back(name);
    world.scene.objects.push_back({name, std::move(shape), X_PO * X_OS, kColor, attachment});
  }
}

// octomap_msgs/OctomapWithPose, or the bare map.
void add_octomap(const YamlElement& message, World& world) {
  if (!message.is_map()) {
    return;
  }
  const std::optional<YamlElement> inner = message.find("octomap");
  if (inner && !inner->is_map()) {
    return;
  }
  const std::optional<YamlElement> origin = message.find("origin");
  if (auto triangles = octomap_mesh(inner.value_or(message))) {
    const std::string name = unique_name(world.scene, "octomap");
    world.names["<octomap>"].push_back(name);
    const Pose X_WM =
        frame_of(message, world.frames) * (origin ? read_pose(*origin) : Pose::Identity());
    world.scene.objects.push_back(
        {name, geometric::Mesh{{}, Eigen::Vector3d::Ones(), std::move(triangles)}, X_WM, kColor,
         std::nullopt});
  }
}

}  // namespace

Pose frame_of(const YamlElement& message, const Frames& frames) {
  const std::optional<YamlElement> header = message.find("header");
  const std::optional<YamlElement> id = header ? header->find("frame_id") : std::nullopt;
  if (!id || id->text().empty()) {
    return Pose::Identity();
  }
  const std::string name = id->text().starts_with('/') ? id->text().substr(1) : id->text();
  const auto frame = frames.find(name);
  if (frame == frames.end()) {
    id->refuse(fmt::format("the frame \"{}\"", name),
               "\"world\", a link of the robot or one of fixed_frame_transforms");
  }
  return frame->second;
}

std::vector<std::pair<Shape, Pose>> read_primitives(const YamlElement& message) {
  std::vector<PlacedShape> shapes;
  read_shapes(message, "primitives", "primitive_poses", read_primitive, shapes);
  return shapes;
}

Reach reach_of(const geometric::RobotInstance& robot) {
  const geometric::RobotModel& model = *robot.model;
  std::vector<double> stretched(static_cast<std::size_t>(model.link_count()), 0.0);
  double farthest = 0.0;
  for (int link = 0; link < model.link_count(); ++link) {
    double& here = stretched[static_cast<std::size_t>(link)];
    if (link > 0) {
      const geometric::Joint& joint = model.joint(link);
      here =
          stretched[static_cast<std::size_t>(model.parent(link))] + joint.X_PJ.translation().norm();
      if (joint.type == geometric::JointType::kPrismatic) {
        here += std::max(std::abs(joint.limits.lower), std::abs(joint.limits.upper));
      }
    }
    double size = 0.0;
    for (const Eigen::Vector3d& vertex : geometric::collision_mesh(model.link(link)).vertices) {
      size = std::max(size, vertex.norm());
    }
    farthest = std::max(farthest, here + size);
  }
  return {robot.X_WB.translation(), 2.0 * farthest + 1.0};
}

void add_world(const YamlElement& message, World& world) {
  message.refuse_slips({"collision_objects", "octomap"});
  if (const auto objects = message.find("collision_objects")) {
    for (const YamlElement& object : objects->items()) {
      add_object(object, frame_of(object, world.frames), Pose::Identity(), std::nullopt, world);
    }
  }
  if (const auto octomap = message.find("octomap")) {
    add_octomap(*octomap, world);
  }
}

void add_attached(const YamlElement& attached, World& world) {
  geometric::Scene& scene = world.scene;
  const YamlElement link = attached.need("link_name");
  if (!scene.robots.front().model->find_link(link.text())) {
    link.refuse(fmt::format("the link \"{}\"", link.text()), "a link of the robot");
  }
  geometric::Attachment attachment;
  attachment.robot = scene.robots.front().name;
  attachment.link = link.text();
  if (const auto touching = attached.find("touch_links")) {
    for (const YamlElement& name : touching->items()) {
      if (scene.robots.front().model->find_link(name.text())) {
        attachment.touching.push_back(name.text());
      } else {
        scene.warnings.push_back(fmt::format("{}: no link \"{}\" that could touch what is held",
                                             name.where(), name.text()));
      }
    }
  }
  const YamlElement object = attached.need("object");
  const Pose& X_WL = world.frames.at(attachment.link);
  add_object(object, X_WL.inverse() * frame_of(object, world.frames), X_WL, attachment, world);
}

}  // namespace handway::import_moveit
