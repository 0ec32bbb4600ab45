#include "formats/scene_sections.h"
#include "handway/geometric/formats/cloud_reader.h"
#include "handway/geometric/formats/mesh_reader.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::geometric {
namespace {

constexpr const char* kShapes = "one of box, sphere, cylinder, cone, mesh and cloud";

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

double length_within(const YamlElement& element, double least, double most) {
  const double length = element.number();
  if (length < least || length > most) {
    element.refuse(element.found(), fmt::format("{:g} to {:g} m", least, most));
  }
  return length;
}

Cloud cloud_of(const YamlElement& element, const std::filesystem::path& folder, Scene& scene) {
  element.allow_keys({"file", "cell", "radius"});
  const YamlElement file = element.need("file");
  const std::filesystem::path found = find_noted(ResourceKind::kObject, file, folder, scene);
  ReadCloud read = read_cloud(found, file.where());
  std::ranges::move(read.warnings, std::back_inserter(scene.warnings));
  CloudCells cells = usual_cells(read.cloud);
  if (const std::optional<YamlElement> cell = element.find("cell")) {
    cells.size = length_within(*cell, kSmallestCell, kLargestCell);
  }
  if (const std::optional<YamlElement> radius = element.find("radius")) {
    cells.radius = length_within(*radius, 0.0, most_radius(cells.size));
  }
  Cloud cloud = make_cloud(std::make_shared<const PointCloud>(std::move(read.cloud)), cells,
                           file.where() + ": cloud " + found.string());
  cloud.file = found;
  return cloud;
}

Shape shape_of(const std::string& kind, const YamlElement& element,
               const std::filesystem::path& folder, Scene& scene) {
  if (kind == "box") {
    return box_of(element);
  }
  if (kind == "mesh") {
    return mesh_of(element, folder);
  }
  if (kind == "cloud") {
    return cloud_of(element, folder, scene);
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

Shape only_shape_of(const YamlElement& object, const std::filesystem::path& folder, Scene& scene) {
  std::optional<Shape> shape;
  for (const std::string kind : {"box", "sphere", "cylinder", "cone", "mesh", "cloud"}) {
    if (const std::optional<YamlElement> element = object.find(kind)) {
      if (shape) {
        element->refuse("a second shape", kShapes, "Make one object for each shape");
      }
      shape = shape_of(kind, *element, folder, scene);
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

// A missing file is a warning: only picking the object needs it, which finds grasps without it,
// too.
std::filesystem::path grasps_of(const YamlElement& element, Scene& scene,
                                const std::filesystem::path& folder) {
  try {
    return find_noted(ResourceKind::kObject, element, folder, scene);
  } catch (const InputError&) {
    const std::filesystem::path file = std::filesystem::absolute(folder) / element.text();
    scene.warnings.push_back(element.where() + ": there is no file of grasps " + file.string());
    return file;
  }
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

const SceneObject& named_object_of(const YamlElement& element, const Scene& scene) {
  const std::string name = element.text();
  std::vector<std::string> names;
  for (const SceneObject& object : scene.objects) {
    if (object.name == name) {
      return object;
    }
    names.push_back(object.name);
  }
  element.refuse(element.found(), "an object of the scene", advise_name(name, names));
}

SceneObject object_of(const YamlElement& element, Scene& scene,
                      const std::filesystem::path& folder) {
  element.allow_keys({"name", "box", "sphere", "cylinder", "cone", "mesh", "cloud", "pose", "color",
                      "attach", "grasps", "group", "hidden", "locked", "solid"});
  SceneObject object;
  object.name = element.need("name").text();
  object.shape = only_shape_of(element, folder, scene);
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
  if (const std::optional<YamlElement> grasps = element.find("grasps")) {
    object.grasps = grasps_of(*grasps, scene, folder);
  }
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
