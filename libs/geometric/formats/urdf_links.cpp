#include "formats/urdf_links.h"

#include "handway/geometric/formats/mesh_reader.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

namespace handway::geometric {
namespace {

constexpr std::array<std::string_view, 5> kShapes = {"box", "sphere", "cylinder", "capsule",
                                                     "mesh"};

// Three numbers are an opaque colour.
std::optional<Color> color_of_material(const pugi::xml_node& material) {
  std::istringstream words(material.child("color").attribute("rgba").value());
  std::vector<float> parts;
  for (std::string word; words >> word;) {
    const std::optional<double> part = parse_number(word);
    if (!part) {
      return std::nullopt;
    }
    parts.push_back(static_cast<float>(std::clamp(*part, 0.0, 1.0)));
  }
  if (parts.size() == 3) {
    parts.push_back(1.0F);
  }
  return parts.size() == 4 ? std::optional(Color{parts[0], parts[1], parts[2], parts[3]})
                           : std::nullopt;
}

// Returns whether a shape is a mere point, as converters give to links that are frames.
bool has_no_size(const pugi::xml_node& collision) {
  const pugi::xml_node geometry = collision.child("geometry");
  const auto zero = [&](const char* shape, const char* attribute) {
    const std::string text = geometry.child(shape).attribute(attribute).value();
    return text.find('0') != std::string::npos &&
           text.find_first_not_of("0. \t\r\n") == std::string::npos;
  };
  return zero("box", "size") || zero("sphere", "radius") ||
         (zero("cylinder", "radius") && zero("cylinder", "length"));
}

pugi::xml_node only_shape(const UrdfElements& elements, const pugi::xml_node& parent,
                          const std::string& element) {
  const pugi::xml_node geometry = elements.only(parent, element, "geometry");
  pugi::xml_node shape;
  for (const pugi::xml_node& child : geometry.children()) {
    if (std::ranges::count(kShapes, std::string_view(child.name())) == 0) {
      continue;
    }
    if (shape) {
      elements.refuse(child, element, fmt::format("a second shape, <{}>", child.name()),
                      "one shape", "Make an element of its own for each");
    }
    shape = child;
  }
  if (!shape) {
    elements.refuse(geometry ? geometry : parent, element, "no shape that can be read",
                    "a <geometry> with a box, sphere, cylinder, capsule or mesh");
  }
  return shape;
}

}  // namespace

UrdfMaterials::UrdfMaterials(const pugi::xml_node& robot) {
  const auto define = [&](const pugi::xml_node& material) {
    const std::string name = material.attribute("name").value();
    if (const std::optional<Color> color = color_of_material(material); color && !name.empty()) {
      colors_.emplace(name, *color);
    }
  };
  std::ranges::for_each(robot.children("material"), define);
  for (const pugi::xml_node& link : robot.children("link")) {
    for (const pugi::xml_node& visual : link.children("visual")) {
      define(visual.child("material"));
    }
  }
}

Color UrdfMaterials::color_of(const pugi::xml_node& visual) {
  const pugi::xml_node material = visual.child("material");
  const std::string name = material.attribute("name").value();
  if (const auto known = colors_.find(name); known != colors_.end()) {
    return known->second;
  }
  if (const std::optional<Color> color = color_of_material(material)) {
    return *color;
  }
  if (!name.empty() && !material.child("texture")) {
    undefined_.insert(name);
  }
  return {};
}

void DrawingFaults::add(const InputError& fault) {
  const InputProblem& problem = fault.problem();
  faults_.push_back(fmt::format("{}: {}: {}", problem.source, problem.element, problem.found));
}

std::string DrawingFaults::summary() const {
  constexpr std::size_t kMostNamed = 3;
  if (faults_.empty()) {
    return "";
  }
  std::string text = fmt::format(
      "{} visual element{} can't be read, the collision geometry is drawn where nothing else is: ",
      faults_.size(), faults_.size() == 1 ? "" : "s");
  const std::size_t named = std::min(kMostNamed, faults_.size());
  for (std::size_t i = 0; i < named; ++i) {
    text += (i == 0 ? "" : "; ") + faults_[i];
  }
  if (faults_.size() > named) {
    text += fmt::format("; and {} more", faults_.size() - named);
  }
  return text;
}

Link UrdfLinks::read(const pugi::xml_node& link) {
  Link result{elements_.document().need(link, "name"), {}, {}};
  for (const pugi::xml_node& collision : link.children("collision")) {
    read_collision(collision, result);
  }
  for (const pugi::xml_node& visual : link.children("visual")) {
    read_visual(visual, result);
  }
  if (result.visual.empty() && link.child("visual")) {
    result.visual = result.collision;
  }
  return result;
}

void UrdfLinks::read_collision(const pugi::xml_node& collision, Link& link) {
  if (has_no_size(collision)) {
    sizeless_.push_back(link.name);
    return;
  }
  try {
    std::ranges::move(read_shapes(collision, "link " + link.name + ", collision"),
                      std::back_inserter(link.collision));
  } catch (const MissingMeshError& fault) {
    missing_.add(fault.problem(),
                 collision.child("geometry").child("mesh").attribute("filename").value());
  }
}

void UrdfLinks::read_visual(const pugi::xml_node& visual, Link& link) {
  try {
    std::vector<LinkGeometry> shapes = read_shapes(visual, "link " + link.name + ", visual");
    const Color color = materials_.color_of(visual);
    for (LinkGeometry& shape : shapes) {
      shape.color = color;
      link.visual.push_back(std::move(shape));
    }
  } catch (const InputError& fault) {
    drawing_.add(fault);
  }
}

// Reads the shape of a <visual> or <collision>; a capsule becomes three shapes.
std::vector<LinkGeometry> UrdfLinks::read_shapes(const pugi::xml_node& parent,
                                                 const std::string& element) {
  const Pose X_LG = elements_.origin(parent, element);
  const pugi::xml_node shape = only_shape(elements_, parent, element);
  const std::string_view kind = shape.name();
  if (kind == "mesh") {
    return {{read_mesh_shape(shape, element), X_LG, {}}};
  }
  if (kind == "box") {
    const std::vector<double> size = elements_.sizes(shape, element, "size", 3);
    return {{Box{{size[0], size[1], size[2]}}, X_LG, {}}};
  }
  const double radius = elements_.sizes(shape, element, "radius", 1).front();
  if (kind == "sphere") {
    return {{Sphere{radius}, X_LG, {}}};
  }
  const double length = elements_.sizes(shape, element, "length", 1).front();
  if (kind == "cylinder") {
    return {{Cylinder{radius, length}, X_LG, {}}};
  }
  std::vector<LinkGeometry> parts;
  for (const auto& [part, X_GS] : capsule_shapes(radius, length)) {
    parts.push_back({part, X_LG * X_GS, {}});
  }
  return parts;
}

Shape UrdfLinks::read_mesh_shape(const pugi::xml_node& mesh, const std::string& element) {
  elements_.need(mesh, element, "filename");
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  if (mesh.attribute("scale")) {
    scale = Eigen::Map<const Eigen::Vector3d>(elements_.numbers(mesh, element, "scale", 3).data());
    if ((scale.array() == 0.0).any()) {
      elements_.refuse(mesh, element, fmt::format("scale=\"{}\"", mesh.attribute("scale").value()),
                       "three numbers other than 0");
    }
  }
  const std::filesystem::path file = meshes_.find(mesh, element);
  return Mesh{file, scale, read_mesh(file, scale, elements_.document().where(mesh))};
}

}  // namespace handway::geometric
