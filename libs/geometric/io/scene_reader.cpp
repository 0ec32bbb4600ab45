#include "handway/geometric/io/scene_reader.h"

#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/io/robot_loader.h"
#include "io/scene_bases.h"
#include "io/scene_configuration.h"
#include "io/scene_constraints.h"
#include "io/scene_objects.h"
#include "io/scene_version.h"

#include <algorithm>

namespace handway::geometric {
namespace {

namespace fs = std::filesystem;

void check_version(const YamlElement& top) {
  const YamlElement version = top.need("handway");
  if (version.number() != kSceneVersion) {
    version.refuse(version.found(), std::to_string(kSceneVersion),
                   "Files of a newer version need a newer Handway");
  }
}

// find_resource(), and a warning if the file has other letters than the scene.
fs::path find_noted(ResourceKind kind, const YamlElement& reference, const fs::path& folder,
                    Scene& scene) {
  const fs::path file = find_resource(kind, reference.text(), folder, reference.where());
  if (differs_in_case(reference.text(), file)) {
    scene.warnings.push_back(reference.where() + ": the file's name has other letters, \"" +
                             file.filename().string() + "\"");
  }
  return file;
}

std::string text_or_empty(const YamlElement& map, const std::string& key) {
  const std::optional<YamlElement> element = map.find(key);
  return element ? element->text() : "";
}

void check_new_name(const YamlElement& element, const Scene& scene, const std::string& name) {
  if (name.empty()) {
    element.refuse("an empty name", "a name");
  }
  if (find_robot(scene, name) || find_object(scene, name)) {
    element.refuse("the name \"" + name + "\" a second time", "names that are unique in the scene",
                   "Give it a \"name\" of its own");
  }
}

RobotInstance robot_of(const YamlElement& element, Scene& scene, const fs::path& folder) {
  element.allow_keys({"name", "model", "base", "moving_base", "bounds", "configuration"});
  const YamlElement model = element.need("model");
  RobotInstance robot;
  robot.file = model.text();
  robot.model =
      with_bases(element, load_robot(find_noted(ResourceKind::kRobot, model, folder, scene)));
  const std::optional<YamlElement> name = element.find("name");
  robot.name = name ? name->text() : robot.model->name();
  check_new_name(name ? *name : element, scene, robot.name);
  if (const std::optional<YamlElement> base = element.find("base")) {
    robot.X_WB = pose_of(*base);
  }
  const std::optional<YamlElement> configuration = element.find("configuration");
  robot.configuration = robot.model->neutral();
  if (configuration) {
    robot.configuration = configuration_of(*configuration, *robot.model, robot.configuration);
  }
  return robot;
}

void add_robots(const YamlElement& top, const fs::path& folder, Scene& scene) {
  const YamlElement list = top.need("robots");
  for (const YamlElement& element : list.items()) {
    scene.robots.push_back(robot_of(element, scene, folder));
    const RobotInstance& robot = scene.robots.back();
    for (const std::string& warning : robot.model->description().warnings) {
      scene.warnings.push_back("robot " + robot.name + ": " + warning);
    }
  }
  if (scene.robots.empty()) {
    list.refuse("an empty list", "at least one robot");
  }
}

void add_objects(const YamlElement& top, const fs::path& folder, Scene& scene) {
  const std::optional<YamlElement> list = top.find("objects");
  if (!list) {
    return;
  }
  for (const YamlElement& element : list->items()) {
    SceneObject object = object_of(element, scene, folder);
    if (const std::optional<YamlElement> mesh = element.find("mesh")) {
      static_cast<void>(find_noted(ResourceKind::kObject, mesh->need("file"), folder, scene));
    }
    check_new_name(element, scene, object.name);
    if (scene.robots.front().model->find_link(object.name)) {
      scene.warnings.push_back("object " + object.name + " has the name of a link of " +
                               scene.robots.front().name);
    }
    scene.objects.push_back(std::move(object));
  }
}

std::optional<Configuration> query_of(const YamlElement& top, const std::string& key,
                                      const RobotInstance& robot) {
  const std::optional<YamlElement> element = top.find(key);
  return element ? std::optional(configuration_of(*element, *robot.model, robot.configuration))
                 : std::nullopt;
}

PlannerChoice planner_of(const YamlElement& element) {
  PlannerChoice planner;
  for (const auto& [key, value] : element.entries()) {
    if (key == "name") {
      planner.name = value.text();
    } else {
      planner.settings.emplace_back(key, value.text());
    }
  }
  return planner;
}

}  // namespace

Scene read_scene(const fs::path& file) {
  const YamlElement top = YamlElement::read(file, "a scene file");
  top.allow_keys({"handway", "name", "description", "robots", "objects", "constraints", "start",
                  "goal", "postures", "hand_basis", "planner"});
  check_version(top);
  const fs::path folder = fs::absolute(file).parent_path();
  Scene scene;
  scene.file = file;
  scene.name = text_or_empty(top, "name");
  scene.description = text_or_empty(top, "description");
  add_robots(top, folder, scene);
  add_objects(top, folder, scene);
  if (const std::optional<YamlElement> constraints = top.find("constraints")) {
    for (const YamlElement& element : constraints->items()) {
      scene.constraints.push_back(constraint_of(element, scene));
    }
  }
  scene.start = query_of(top, "start", scene.robots.front());
  scene.goal = query_of(top, "goal", scene.robots.front());
  bound_bases(top.need("robots"), scene);
  if (const std::optional<YamlElement> postures = top.find("postures")) {
    for (const auto& [name, values] : postures->entries()) {
      scene.postures.push_back(posture_of(values, *scene.robots.front().model, name));
    }
  }
  if (const std::optional<YamlElement> basis = top.find("hand_basis")) {
    scene.hand_basis = basis->text();
    static_cast<void>(find_noted(ResourceKind::kHandBasis, *basis, folder, scene));
  }
  if (const std::optional<YamlElement> planner = top.find("planner")) {
    scene.planner = planner_of(*planner);
  }
  return scene;
}

}  // namespace handway::geometric
