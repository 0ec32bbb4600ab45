#include "handway/planning/tasks/object_choice.h"

#include "handway/geometric/formats/mesh_reader.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/plural.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/setup/placing.h"
#include "handway/planning/edits/scene_edits.h"
#include "handway/planning/tasks/resting_places.h"
#include "handway/sampling/sequences/random_stream.h"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

namespace handway::planning {
namespace {

using geometric::InputError;
using geometric::Pose;
using geometric::SceneObject;
using geometric::YamlElement;

constexpr double kLargestSize = 2.0;      // m, of an object that a hand picks
constexpr double kLargestScale = 1000.0;  // of a mesh
constexpr const char* kKinds = "one of object, box, sphere, cylinder, cone and mesh";

// A number, or a range [lower, upper].
SizeRange size_range(const YamlElement& element, double most, const char* expected) {
  SizeRange range;
  if (element.is_list()) {
    const Eigen::VectorXd ends = element.numbers(2);
    range = {ends[0], ends[1]};
  } else {
    range.lower = range.upper = element.number();
  }
  const std::string found =
      element.is_list() ? fmt::format("the range from {:g} to {:g}", range.lower, range.upper)
                        : element.found();
  if (range.lower > range.upper) {
    element.refuse(found, "[lower, upper] with a lower end that is not above the upper one");
  }
  if (range.lower <= 0.0 || range.upper > most) {
    element.refuse(found, expected);
  }
  return range;
}

SizeRange length_range(const YamlElement& element) {
  static const std::string kExpected =
      fmt::format("sizes above 0 m, up to {:g} m: a number or [lower, upper]", kLargestSize);
  return size_range(element, kLargestSize, kExpected.c_str());
}

SizeRange scale_range(const YamlElement& element) {
  static const std::string kExpected =
      fmt::format("scales above 0, up to {:g}: a number or [lower, upper]", kLargestScale);
  return size_range(element, kLargestScale, kExpected.c_str());
}

std::vector<SizeRange> edge_ranges(const YamlElement& box) {
  box.allow_keys({"size"});
  const YamlElement size = box.need("size");
  std::vector<SizeRange> edges;
  if (!size.is_list() || size.items().size() != 3) {
    size.refuse(size.found(), "three edges, each a number or [lower, upper], m");
  }
  for (const YamlElement& edge : size.items()) {
    edges.push_back(length_range(edge));
  }
  return edges;
}

void read_mesh_choice(const YamlElement& element, const std::filesystem::path& folder,
                      ObjectChoice& choice) {
  element.allow_keys({"file", "scale"});
  const YamlElement file = element.need("file");
  choice.mesh_file =
      geometric::find_resource(geometric::ResourceKind::kObject, file.text(), folder, file.where());
  choice.mesh = geometric::read_mesh(choice.mesh_file, Eigen::Vector3d::Ones(), file.where());
  const std::optional<YamlElement> scale = element.find("scale");
  choice.sizes = {scale ? scale_range(*scale) : SizeRange{1.0, 1.0}};
  const Eigen::Vector3d size = bounding_box(*choice.mesh).size();
  if (size.maxCoeff() * choice.sizes.front().upper > kLargestSize) {
    element.refuse(fmt::format("a mesh of {:.3g} m", size.maxCoeff() * choice.sizes.front().upper),
                   fmt::format("one of at most {:g} m", kLargestSize),
                   "If its file is in mm, give scales around 0.001");
  }
}

void read_shape(const YamlElement& element, const std::filesystem::path& folder,
                ObjectChoice& choice) {
  if (choice.shape == "box") {
    choice.sizes = edge_ranges(element);
  } else if (choice.shape == "mesh") {
    read_mesh_choice(element, folder, choice);
  } else if (choice.shape == "sphere") {
    element.allow_keys({"radius"});
    choice.sizes = {length_range(element.need("radius"))};
  } else {
    element.allow_keys({"radius", "length"});
    choice.sizes = {length_range(element.need("radius")), length_range(element.need("length"))};
  }
}

bool is_support(const Task& task, const std::string& name) {
  return std::ranges::any_of(task, [&](const TaskStep& step) {
    const auto* place = std::get_if<PlaceStep>(&step);
    return place != nullptr && std::ranges::count(place->supports, name) > 0;
  });
}

// Checks an object of the scene that may be picked.
void check_scene_object(const YamlElement& element, const geometric::Scene& scene,
                        const Task& task) {
  const std::string name = element.text();
  const SceneObject* object = geometric::find_object(scene, name);
  if (object == nullptr) {
    std::vector<std::string> there;
    std::ranges::transform(scene.objects, std::back_inserter(there), &SceneObject::name);
    element.refuse(element.found(), "an object of the scene", geometric::advise_name(name, there));
  }
  if (object != nullptr && object->attachment) {
    element.refuse("an object on a link of a robot", "an object that stands in the world");
  }
  if (is_support(task, name)) {
    element.refuse("the object on which the task places", "another object");
  }
}

ObjectChoice choice_of(const YamlElement& entry, const std::filesystem::path& folder,
                       const geometric::Scene& scene, const Task& task) {
  entry.allow_keys({"name", "object", "box", "sphere", "cylinder", "cone", "mesh", "rpy_deg"});
  ObjectChoice choice;
  std::string kind;
  for (const std::string key : {"object", "box", "sphere", "cylinder", "cone", "mesh"}) {
    const std::optional<YamlElement> element = entry.find(key);
    if (!element) {
      continue;
    }
    if (!kind.empty()) {
      element->refuse("a second shape or object", kKinds, "Make an entry for each");
    }
    kind = key;
    if (key == "object") {
      check_scene_object(*element, scene, task);
      choice.scene_object = element->text();
    } else {
      choice.shape = key;
      read_shape(*element, folder, choice);
    }
  }
  if (kind.empty()) {
    entry.refuse("neither a shape nor an object", kKinds);
  }
  const std::string usual = kind == "object" ? choice.scene_object
                            : kind == "mesh" ? choice.mesh_file.stem().string()
                                             : kind;
  choice.name = entry.text_or("name", usual);
  if (const std::optional<YamlElement> angles = entry.find("rpy_deg")) {
    if (kind == "object") {
      angles->refuse("an orientation", "none for an object of the scene", "Turn it in the scene");
    }
    const Eigen::VectorXd rpy = angles->numbers(3);
    choice.R_WO = geometric::pose_from_rpy(Eigen::Vector3d::Zero(), geometric::radians(rpy[0]),
                                           geometric::radians(rpy[1]), geometric::radians(rpy[2]))
                      .linear();
  }
  return choice;
}

// @throws InputError unless the task picks one object, which stands in the world.
void check_task(const std::filesystem::path& file, const geometric::Scene& scene,
                const Task& task) {
  const std::vector<std::string> picked = picked_objects(task);
  if (picked.size() != 1) {
    throw InputError(
        {file.string(), "",
         picked.empty()
             ? std::string("a task that picks nothing")
             : fmt::format("a task that picks {}: {}", geometric::plural(picked.size(), "object"),
                           fmt::join(picked, ", ")),
         "a task that picks one object, whose place the objects of the file take", ""});
  }
  if (need_object(scene, picked.front()).attachment) {
    throw InputError({file.string(), "",
                      fmt::format("a task that picks {}, which is on a link", picked.front()),
                      "a task that picks an object that stands in the world", ""});
  }
}

geometric::Shape shape_of(const ObjectChoice& choice, const std::vector<double>& sizes) {
  if (choice.shape == "box") {
    return geometric::Box{{sizes[0], sizes[1], sizes[2]}};
  }
  if (choice.shape == "sphere") {
    return geometric::Sphere{sizes[0]};
  }
  if (choice.shape == "cylinder") {
    return geometric::Cylinder{sizes[0], sizes[1]};
  }
  if (choice.shape == "cone") {
    return geometric::Cone{sizes[0], sizes[1]};
  }
  const Eigen::Vector3d scale = Eigen::Vector3d::Constant(sizes[0]);
  return geometric::Mesh{choice.mesh_file, scale,
                         std::make_shared<const geometric::TriangleMesh>(
                             transformed(*choice.mesh, Pose::Identity(), scale))};
}

}  // namespace

std::vector<ObjectChoice> read_object_choices(const std::filesystem::path& file,
                                              const geometric::Scene& scene, const Task& task) {
  const YamlElement top = YamlElement::read(file, "a file of objects");
  check_task(file, scene, task);
  top.allow_keys({"objects"});
  const YamlElement list = top.need("objects");
  std::vector<ObjectChoice> choices;
  for (const YamlElement& entry : list.items()) {
    ObjectChoice choice = choice_of(entry, file.parent_path(), scene, task);
    if (std::ranges::count(choices, choice.name, &ObjectChoice::name) > 0) {
      entry.refuse(fmt::format("a second object \"{}\"", choice.name), "a name of its own",
                   "Give it a name");
    }
    choices.push_back(std::move(choice));
  }
  if (choices.empty()) {
    list.refuse("no object", "at least one");
  }
  return choices;
}

DrawnObject draw_object(std::span<const ObjectChoice> choices, std::uint64_t seed) {
  constexpr std::uint64_t kStream = std::uint64_t{1} << 32U;  // no other use of the seed has it
  sampling::RandomStream random = sampling::RandomStream(seed).fork(kStream);
  DrawnObject drawn;
  drawn.choice = static_cast<std::size_t>(random.below(choices.size()));
  const ObjectChoice& choice = choices[drawn.choice];
  for (const SizeRange& range : choice.sizes) {
    drawn.sizes.push_back(
        std::min(range.lower + (range.upper - range.lower) * random.uniform(), range.upper));
  }
  if (choice.scene_object.empty()) {
    drawn.shape = shape_of(choice, drawn.sizes);
  }
  return drawn;
}

SceneState with_drawn_object(const SceneState& state, const std::string& target,
                             const ObjectChoice& choice, const DrawnObject& drawn) {
  if (!drawn.shape) {
    return state;
  }
  const SceneObject& before = need_object(*state.scene, target);
  const geometric::Aabb box =
      bounding_box(transformed(*geometric::tessellate(before.shape), before.X_PO));
  const Eigen::Vector3d foot(box.centre().x(), box.centre().y(),
                             box.lower.z() - geometric::kRestingGap);
  geometric::Scene scene = *state.scene;
  SceneObject& object = *std::ranges::find(scene.objects, target, &SceneObject::name);
  object.shape = *drawn.shape;
  object.solid = true;
  object.grasps.clear();
  object.X_PO = Pose::Identity();
  object.X_PO.linear() = choice.R_WO;
  object.X_PO = places_at(object, Pose(Eigen::Translation3d(foot)), 1).front();
  SceneState changed = state;
  changed.scene = std::make_shared<const geometric::Scene>(std::move(scene));
  return changed;
}

Task with_picked_object(Task task, const std::string& target, const std::string& object) {
  for (TaskStep& step : task) {
    auto* pick = std::get_if<PickStep>(&step);
    if (pick != nullptr && pick->object == target) {
      pick->object = object;
    }
  }
  return task;
}

Eigen::Vector3d size_of_object(const SceneObject& object) {
  return bounding_box(*geometric::tessellate(object.shape)).size();
}

}  // namespace handway::planning
