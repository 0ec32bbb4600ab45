#include "world_objects.h"

#include "handway/geometric/collision/collision_world.h"
#include "handway/geometric/formats/mesh_reader.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "octomap_mesh.h"
#include "problem_files.h"
#include "ros_messages.h"

#include <fmt/format.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::import_moveit {
namespace {

using geometric::TriangleMesh;
using geometric::YamlElement;

namespace fs = std::filesystem;
using geometric::Pose;
using geometric::Shape;

constexpr geometric::Color kColor{0.55, 0.62, 0.68};
constexpr double kSmallestNormal = 1e-9;
constexpr double kOnPlane = 1e-6;  // m

// Numbers of shape_msgs/SolidPrimitive, and the words of MotionBenchMaker.
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
  // The message has room for three sizes; those behind the ones of the shape have no meaning.
  const auto sizes = [&](int count) {
    const int written = list.is_list() ? static_cast<int>(list.items().size()) : count;
    const Eigen::VectorXd values = list.numbers(written == 3 ? written : count).head(count);
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
  const std::vector<YamlElement> items = object.items_of(key);
  const std::vector<YamlElement> placed = object.items_of(poses);
  if (!placed.empty() && placed.size() != items.size()) {
    object.need(poses).refuse(fmt::format("{} poses", placed.size()),
                              fmt::format("{}, one for each of {}", items.size(), key));
  }
  for (std::size_t i = 0; i < items.size(); ++i) {
    shapes.emplace_back(read(items[i]), placed.empty() ? Pose::Identity() : read_pose(placed[i]));
  }
}

// The plane ax + by + cz + d = 0 as a box on the side opposite to the robot's base.
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

std::vector<ObjectShape> shapes_of(const YamlElement& object, World& world) {
  std::vector<PlacedShape> solids;
  read_shapes(object, "primitives", "primitive_poses", read_primitive, solids);
  read_shapes(
      object, "meshes", "mesh_poses",
      [&](const YamlElement& mesh) {
        return read_mesh_shape(mesh, world.folder, world.scene.warnings);
      },
      solids);
  std::vector<std::pair<YamlElement, Pose>> planes;
  read_shapes(
      object, "planes", "plane_poses", [](const YamlElement& plane) { return plane; }, planes);
  std::vector<ObjectShape> shapes;
  for (auto& [shape, X_OS] : solids) {
    shapes.push_back({std::move(shape), X_OS});
  }
  for (const auto& [plane, X_OS] : planes) {
    shapes.push_back({geometric::Box{}, X_OS, plane});
  }
  if (shapes.empty()) {
    object.refuse("no primitives, meshes or planes", "at least one of them");
  }
  return shapes;
}

// Returns a shape of an object as the scene has it. @param X_WO of the object.
PlacedShape placed(const ObjectShape& one, const Pose& X_WO, const Reach& reach) {
  if (!one.plane) {
    return {one.shape, one.X_OS};
  }
  auto [shape, X_SB] = half_space(*one.plane, X_WO * one.X_OS, reach);
  return {std::move(shape), one.X_OS * X_SB};
}

std::string unique_name(const geometric::Scene& scene, const std::string& wanted) {
  std::string name = wanted;
  for (int n = 2; find_object(scene, name) != nullptr || find_robot(scene, name) != nullptr; ++n) {
    name = fmt::format("{}_{}", wanted, n);
  }
  return name;
}

enum class Operation { kAdd, kRemove, kAppend, kMove };

// moveit_msgs/CollisionObject's byte: as a number, a character ("\x01"), base64 (!!binary AQ==), a
// list of one, bytes of Python, or its name.
std::optional<Operation> operation_called(const YamlElement& element) {
  if (element.is_list()) {
    const std::vector<YamlElement> items = element.items();
    return items.size() == 1 ? operation_called(items.front()) : std::nullopt;
  }
  std::string text = element.text();
  if (text.size() == 1 && static_cast<unsigned char>(text[0]) < 4) {
    return static_cast<Operation>(text[0]);
  }
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  text =
      text.substr(text.find_last_of(".:") == std::string::npos ? 0 : text.find_last_of(".:") + 1);
  constexpr std::array<std::array<const char*, 8>, 4> kSpellings = {
      {{"0", "0x0", "0x00", "aa==", "add", "\\0", "\\x00", "b'\\x00'"},
       {"1", "0x1", "0x01", "aq==", "remove", "\\1", "\\x01", "b'\\x01'"},
       {"2", "0x2", "0x02", "ag==", "append", "\\2", "\\x02", "b'\\x02'"},
       {"3", "0x3", "0x03", "aw==", "move", "\\3", "\\x03", "b'\\x03'"}}};
  for (std::size_t i = 0; i < kSpellings.size(); ++i) {
    if (std::ranges::find(kSpellings.at(i), text) != kSpellings.at(i).end()) {
      return static_cast<Operation>(i);
    }
  }
  const std::optional<double> number = geometric::parse_number(text);
  return number && (*number == 0.0 || *number == 1.0 || *number == 2.0 || *number == 3.0)
             ? std::optional(static_cast<Operation>(static_cast<int>(*number)))
             : std::nullopt;
}

Operation operation_of(const YamlElement& object) {
  const std::optional<YamlElement> element = object.find("operation");
  if (!element || (element->is_scalar() && element->text().empty())) {
    return Operation::kAdd;
  }
  const std::optional<Operation> operation = operation_called(*element);
  if (!operation) {
    element->refuse(element->found(), "ADD (0), REMOVE (1), APPEND (2) or MOVE (3)");
  }
  return *operation;
}

void remove_objects(const std::string& id, World& world) {
  for (const std::string& name : world.names[id]) {
    std::erase_if(world.scene.objects,
                  [&](const geometric::SceneObject& object) { return object.name == name; });
  }
  world.names.erase(id);
  world.objects.erase(id);
}

geometric::SceneObject& object_called(const std::string& name, const World& world) {
  return *std::ranges::find(world.scene.objects, name, &geometric::SceneObject::name);
}

// The link that carries an object; nothing for an object of the world.
std::optional<std::string> carrier_of(const std::string& id, const World& world) {
  const auto names = world.names.find(id);
  if (names == world.names.end() || names->second.empty()) {
    return std::nullopt;
  }
  const auto& attachment = object_called(names->second.front(), world).attachment;
  return attachment ? std::optional(attachment->link) : std::nullopt;
}

bool is_attached(const std::string& id, const World& world) {
  return carrier_of(id, world).has_value();
}

// The pose of an object in the world.
Pose object_pose(const std::string& id, const WorldObject& whole, const World& world) {
  const std::optional<std::string> carrier = carrier_of(id, world);
  return carrier ? world.frames.at(*carrier) * whole.X_PO : whole.X_PO;
}

// The pose in the world of the frame of this name: that of an object, or a subframe of one.
std::optional<Pose> object_frame(const std::string& name, const World& world) {
  for (const auto& [id, whole] : world.objects) {
    if (name == id) {
      return object_pose(id, whole, world);
    }
    const auto subframe = name.starts_with(id + "/")
                              ? whole.subframes.find(name.substr(id.size() + 1))
                              : whole.subframes.end();
    if (subframe != whole.subframes.end()) {
      return object_pose(id, whole, world) * subframe->second;
    }
  }
  return std::nullopt;
}

// The pose in the world of the frame in a message's header. @throws InputError if it is unknown.
Pose header_frame(const YamlElement& message, const World& world) {
  const std::optional<std::string> name = frame_name(message);
  const std::optional<Pose> X_WF =
      name && !world.frames.contains(*name) ? object_frame(*name, world) : std::nullopt;
  return X_WF ? *X_WF : frame_of(message, world.frames);
}

void read_subframes(const YamlElement& object, WorldObject& whole) {
  const std::vector<YamlElement> names = object.items_of("subframe_names");
  const std::vector<YamlElement> poses = object.items_of("subframe_poses");
  if (names.size() != poses.size()) {
    object.need("subframe_names")
        .refuse(fmt::format("{} names", names.size()),
                fmt::format("{}, one for each of subframe_poses", poses.size()));
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    whole.subframes[names[i].text()] = read_pose(poses[i]);
  }
}

// The pose of a message in the frame to which its object is fixed.
Pose pose_of(const YamlElement& object, const Pose& X_PF) {
  const std::optional<YamlElement> pose = object.find("pose");
  return pose ? X_PF * read_pose(*pose) : X_PF;
}

// @param X_PF pose of the object's frame in its carrier. @param X_WP pose of the carrier in the
// world.
void add_object(const YamlElement& object, const Pose& X_PF, const Pose& X_WP,
                const std::optional<geometric::Attachment>& attachment, World& world) {
  const Pose X_PO = pose_of(object, X_PF);
  const std::string id = object.need("id").text();
  WorldObject& whole = world.objects.try_emplace(id, WorldObject{X_PO}).first->second;
  read_subframes(object, whole);
  for (ObjectShape& one : shapes_of(object, world)) {
    one.X_OS = whole.X_PO.inverse() * X_PO * one.X_OS;
    auto [shape, X_OB] = placed(one, X_WP * whole.X_PO, world.reach);
    const std::string name = unique_name(world.scene, id);
    world.names[id].push_back(name);
    world.scene.objects.push_back({name, std::move(shape), whole.X_PO * X_OB, kColor, attachment});
    whole.shapes.push_back(std::move(one));
  }
}

// Poses of shapes in a message that also moves them; as many as the object has.
std::vector<Pose> shape_poses(const YamlElement& object) {
  std::vector<Pose> poses;
  for (const char* key : {"primitive_poses", "mesh_poses", "plane_poses"}) {
    for (const YamlElement& pose : object.items_of(key)) {
      poses.push_back(read_pose(pose));
    }
  }
  return poses;
}

// Moves an object of the world to the message's pose, with its shapes unchanged or at the message's
// poses. MoveIt moves no attached objects either.
void move_object(const YamlElement& object, const Pose& X_WF, World& world) {
  const std::string id = object.need("id").text();
  const auto found = world.objects.find(id);
  if (found == world.objects.end() || is_attached(id, world)) {
    world.scene.warnings.push_back(fmt::format(
        "{}: {}", object.where(),
        found == world.objects.end()
            ? fmt::format("there is no object \"{}\" to move", id)
            : fmt::format("object \"{}\" is attached, and stays where its link holds it", id)));
    return;
  }
  WorldObject& whole = found->second;
  whole.X_PO = pose_of(object, X_WF);
  const std::vector<Pose> poses = shape_poses(object);
  const bool moves_shapes = poses.size() == whole.shapes.size();
  for (std::size_t i = 0; i < whole.shapes.size(); ++i) {
    ObjectShape& one = whole.shapes[i];
    one.X_OS = moves_shapes ? poses[i] : one.X_OS;
    auto [shape, X_OB] = placed(one, whole.X_PO, world.reach);
    geometric::SceneObject& part = object_called(world.names[id][i], world);
    part.shape = std::move(shape);
    part.X_PO = whole.X_PO * X_OB;
  }
}

void check_keys(const YamlElement& object) {
  object.refuse_slips({"header", "id", "type", "pose", "primitives", "primitive_poses", "meshes",
                       "mesh_poses", "planes", "plane_poses", "subframe_names", "subframe_poses",
                       "operation"});
}

std::string id_of(const YamlElement& object) {
  const std::optional<YamlElement> id = object.find("id");
  return id ? id->text() : "";
}

void remove_from_world(const YamlElement& object, World& world) {
  const std::string id = id_of(object);
  if (!id.empty() && (!world.objects.contains(id) || is_attached(id, world))) {
    return;  // it is not there already
  }
  std::vector<std::string> ids{id};
  if (id.empty()) {  // all
    ids.clear();
    for (const auto& [one, whole] : world.objects) {
      if (!is_attached(one, world)) {
        ids.push_back(one);
      }
    }
  }
  for (const std::string& one : ids) {
    remove_objects(one, world);
  }
}

void take_world_object(const YamlElement& object, World& world) {
  check_keys(object);
  const Operation operation = operation_of(object);
  if (operation == Operation::kRemove) {
    remove_from_world(object, world);
    return;
  }
  const Pose X_WF = header_frame(object, world);
  if (operation == Operation::kMove) {
    move_object(object, X_WF, world);
    return;
  }
  const std::string id = object.need("id").text();
  if (operation == Operation::kAdd && world.objects.contains(id)) {
    world.scene.warnings.push_back(
        fmt::format("{}: object \"{}\" is added again and replaces the first", object.where(), id));
    remove_objects(id, world);
  }
  add_object(object, X_WF, Pose::Identity(), std::nullopt, world);
}

// Reads octomap_msgs/OctomapWithPose, or the bare map.
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
        header_frame(message, world) * (origin ? read_pose(*origin) : Pose::Identity());
    world.scene.objects.push_back(
        {name, geometric::Mesh{{}, Eigen::Vector3d::Ones(), std::move(triangles)}, X_WM, kColor,
         std::nullopt});
  }
}

geometric::Attachment attachment_of(const YamlElement& attached, geometric::Scene& scene) {
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
  return attachment;
}

bool has_shapes(const YamlElement& object) {
  return !object.items_of("primitives").empty() || !object.items_of("meshes").empty() ||
         !object.items_of("planes").empty();
}

// Attaches an object of the world to the link, or detaches a link's objects.
void fix_to(const std::string& id, const Pose& X_NewOld,
            const std::optional<geometric::Attachment>& attachment, World& world) {
  world.objects[id].X_PO = X_NewOld * world.objects[id].X_PO;
  for (const std::string& name : world.names[id]) {
    geometric::SceneObject& object = object_called(name, world);
    object.X_PO = X_NewOld * object.X_PO;
    object.attachment = attachment;
  }
}

// Detaches objects into the world; without an id all, or all of one link.
void detach(const YamlElement& attached, const YamlElement& object, World& world) {
  const std::string id = id_of(object);
  const std::optional<YamlElement> link = attached.find("link_name");
  const std::string of_link = link ? link->text() : "";
  std::vector<std::string> ids;
  for (const auto& [one, whole] : world.objects) {
    const std::optional<std::string> carrier = carrier_of(one, world);
    if ((id.empty() || one == id) && carrier && (of_link.empty() || *carrier == of_link)) {
      ids.push_back(one);
    }
  }
  if (ids.empty()) {
    world.scene.warnings.push_back(fmt::format("{}: nothing{} is attached that could be removed",
                                               attached.where(),
                                               id.empty() ? "" : " called \"" + id + '"'));
  }
  for (const std::string& one : ids) {
    fix_to(one, world.frames.at(*carrier_of(one, world)), std::nullopt, world);
  }
}

}  // namespace

std::optional<std::string> frame_name(const YamlElement& message) {
  const std::optional<YamlElement> header = message.find("header");
  const std::optional<YamlElement> id = header ? header->find("frame_id") : std::nullopt;
  if (!id || id->text().empty()) {
    return std::nullopt;
  }
  return id->text().starts_with('/') ? id->text().substr(1) : id->text();
}

Pose frame_of(const YamlElement& message, const Frames& frames) {
  const std::optional<std::string> name = frame_name(message);
  if (!name) {
    return Pose::Identity();
  }
  const auto frame = frames.find(*name);
  if (frame == frames.end()) {
    message.need("header")
        .need("frame_id")
        .refuse(
            fmt::format("the frame \"{}\"", *name),
            "\"world\", a link of the robot, one of fixed_frame_transforms, or an object that is "
            "there already");
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
      take_world_object(object, world);
    }
  }
  if (const auto octomap = message.find("octomap")) {
    add_octomap(*octomap, world);
  }
}

void add_attached(const YamlElement& attached, World& world) {
  const YamlElement object = attached.need("object");
  check_keys(object);
  const Operation operation = operation_of(object);
  if (operation == Operation::kRemove) {
    detach(attached, object, world);
    return;
  }
  const geometric::Attachment attachment = attachment_of(attached, world.scene);
  const Pose& X_WL = world.frames.at(attachment.link);
  const Pose X_LF = X_WL.inverse() * header_frame(object, world);
  const std::string id = object.need("id").text();
  const bool is_known = world.objects.contains(id);
  if (operation == Operation::kMove) {
    world.scene.warnings.push_back(
        fmt::format("{}: attached objects can't be moved; \"{}\" stays", object.where(), id));
    return;
  }
  if (is_known && !has_shapes(object) && !is_attached(id, world)) {
    fix_to(id, X_WL.inverse(), attachment, world);
    return;
  }
  if (is_known && (operation == Operation::kAdd || !is_attached(id, world))) {
    world.scene.warnings.push_back(fmt::format(
        "{}: object \"{}\" is attached and replaces that of the same name", object.where(), id));
    remove_objects(id, world);
  }
  add_object(object, X_LF, X_WL, attachment, world);
}

Frames frames_of(const World& world) {
  Frames frames = world.frames;
  for (const auto& [id, whole] : world.objects) {
    if (is_attached(id, world)) {
      continue;
    }
    frames.emplace(id, whole.X_PO);
    for (const auto& [name, X_OF] : whole.subframes) {
      frames.emplace(fmt::format("{}/{}", id, name), whole.X_PO * X_OF);
    }
  }
  return frames;
}

HeldFrames held_frames_of(const World& world) {
  HeldFrames frames;
  for (const auto& [id, whole] : world.objects) {
    const std::optional<std::string> carrier = carrier_of(id, world);
    if (!carrier) {
      continue;
    }
    frames.emplace(id, HeldFrame{*carrier, whole.X_PO});
    for (const auto& [name, X_OF] : whole.subframes) {
      frames.emplace(fmt::format("{}/{}", id, name), HeldFrame{*carrier, whole.X_PO * X_OF});
    }
  }
  return frames;
}

bool remove_attached(World& world) {
  std::vector<std::string> ids;
  for (const auto& [id, whole] : world.objects) {
    if (is_attached(id, world)) {
      ids.push_back(id);
    }
  }
  for (const std::string& id : ids) {
    remove_objects(id, world);
  }
  return !ids.empty();
}

}  // namespace handway::import_moveit
