#include "handway/planning/tasks/task_file.h"

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

namespace handway::planning {
namespace {

using geometric::YamlElement;

// The name of an object of the scene.
std::string object_name(const YamlElement& element, const geometric::Scene& scene) {
  std::string name = element.text();
  if (geometric::find_object(scene, name) == nullptr) {
    std::vector<std::string> names;
    std::ranges::transform(scene.objects, std::back_inserter(names), &geometric::SceneObject::name);
    element.refuse(element.found(), "an object of the scene", geometric::advise_name(name, names));
  }
  return name;
}

// A length in m.
double length_or(const YamlElement& element, const std::string& key, double otherwise) {
  constexpr double kMost = 10.0;
  const auto found = element.find(key);
  const double length = found ? found->number() : otherwise;
  if (!(length >= 0.0 && length <= kMost)) {
    found->refuse(found->found(), fmt::format("a length from 0 to {:g} m", kMost));
  }
  return length;
}

PickStep pick_of(const YamlElement& element, const geometric::Scene& scene) {
  PickStep pick;
  if (element.is_scalar()) {
    pick.object = object_name(element, scene);
    return pick;
  }
  element.allow_keys({"object", "approach", "lift"});
  pick.object = object_name(element.need("object"), scene);
  pick.approach = length_or(element, "approach", pick.approach);
  pick.lift = length_or(element, "lift", pick.lift);
  return pick;
}

geometric::Pose pose_of(const YamlElement& element) {
  element.allow_keys({"xyz", "rpy_deg"});
  const Eigen::Vector3d xyz = element.need("xyz").numbers(3);
  const Eigen::Vector3d rpy =
      geometric::kDegree * element.numbers_or("rpy_deg", Eigen::Vector3d::Zero());
  return geometric::pose_from_rpy(xyz, rpy.x(), rpy.y(), rpy.z());
}

PlaceStep place_of(const YamlElement& element, const geometric::Scene& scene) {
  PlaceStep place;
  if (element.is_scalar()) {
    place.support = object_name(element, scene);
    return place;
  }
  element.allow_keys({"on", "pose", "lower", "retreat"});
  const auto on = element.find("on");
  const auto pose = element.find("pose");
  if (on.has_value() == pose.has_value()) {
    element.refuse(on ? "both on and pose" : "neither on nor pose", "one of them");
  }
  if (on) {
    place.support = object_name(*on, scene);
  } else {
    place.pose = pose_of(*pose);
  }
  place.lower = length_or(element, "lower", place.lower);
  place.retreat = length_or(element, "retreat", place.retreat);
  return place;
}

TaskStep step_of(const YamlElement& element, const geometric::Scene& scene) {
  element.allow_keys({"pick", "place", "move"});
  const auto entries = element.entries();
  if (entries.size() != 1) {
    element.refuse(fmt::format("a map of {} keys", entries.size()),
                   "a map with one key: pick, place or move");
  }
  const auto& [kind, value] = entries.front();
  if (kind == "pick") {
    return pick_of(value, scene);
  }
  if (kind == "place") {
    return place_of(value, scene);
  }
  return move_to_posture(scene, value.text(), value.where());
}

}  // namespace

Task read_task(const std::filesystem::path& file, const geometric::Scene& scene) {
  const YamlElement top = YamlElement::read(file, "a task file");
  top.allow_keys({"handway_task", "steps"});
  const YamlElement version = top.need("handway_task");
  if (version.number() != kTaskVersion) {
    version.refuse(version.found(), fmt::format("version {}", kTaskVersion));
  }
  Task task;
  for (const YamlElement& step : top.need("steps").items()) {
    task.push_back(step_of(step, scene));
  }
  if (task.empty()) {
    top.need("steps").refuse("an empty list", "at least one step");
  }
  return task;
}

MoveStep move_to_posture(const geometric::Scene& scene, const std::string& name,
                         const std::string& source) {
  const geometric::RobotInstance& robot = scene.robots.front();
  MoveStep move{scene.start.value_or(robot.configuration), name};
  if (name == "start") {
    return move;
  }
  std::vector<geometric::NamedPosture> postures = scene.postures;
  std::ranges::copy(robot.model->description().postures, std::back_inserter(postures));
  const auto found = std::ranges::find(postures, name, &geometric::NamedPosture::name);
  if (found == postures.end()) {
    std::vector<std::string> names{"start"};
    std::ranges::transform(postures, std::back_inserter(names), &geometric::NamedPosture::name);
    throw geometric::InputError({source, "move", "\"" + name + "\"",
                                 "start, or a posture of the scene or its robot",
                                 geometric::advise_name(name, names)});
  }
  for (const auto& [joint, value] : found->values) {
    if (const auto v = robot.model->find_variable(joint)) {
      move.q[*v] = value;
    }
  }
  return move;
}

}  // namespace handway::planning
