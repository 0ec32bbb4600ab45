#include "formats/scene_sections.h"
#include "handway/geometric/formats/scene_file.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/number_text.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/geometric/setup/moving_group.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>

namespace handway::geometric {
namespace {

/// A map of joint names to values (rad, m), as for configuration_of().
/// @returns the values of the variables in it; without a group.
/// @throws InputError as configuration_of().
NamedPosture posture_of(const YamlElement& element, const RobotModel& model,
                        const std::string& name) {
  const Configuration q = configuration_of(element, model, model.neutral());
  NamedPosture posture{name, {}, {}};
  for (const auto& [joint, value] : element.entries()) {
    const int variable = model.mimic_mapping(carried_link(value, model, joint)).variable;
    posture.values[model.variable(variable).name] = q[variable];
  }
  return posture;
}

std::string body_of(const YamlElement& element, const Scene& scene) {
  std::string name = element.text();
  const std::vector<std::string> bodies = constrainable_bodies(scene);
  if (std::ranges::find(bodies, name) == bodies.end()) {
    element.refuse(
        element.found() + (find_object(scene, name) ? ", which no link of the robot carries" : ""),
        "an object on a link of " + scene.robots.front().name + ", or one of its links",
        advise_name(name, bodies));
  }
  return name;
}

Eigen::Vector3d direction_of(const YamlElement& map, const std::string& key) {
  const std::optional<YamlElement> element = map.find(key);
  if (!element) {
    return Eigen::Vector3d::UnitZ();
  }
  const Eigen::Vector3d direction = element->numbers(3);
  if (direction.norm() < 1e-6) {
    element->refuse("the direction 0", "a vector that is not 0");
  }
  return direction;
}

OrientationConstraint orientation_of(const YamlElement& element) {
  element.allow_keys({"axis", "direction", "angle_deg"});
  const YamlElement angle = element.need("angle_deg");
  if (angle.number() <= 0.0 || angle.number() > 180.0) {
    angle.refuse(angle.found(), "an angle above 0 and up to 180 degrees");
  }
  return {direction_of(element, "axis"), direction_of(element, "direction"),
          radians(angle.number())};
}

PositionConstraint position_of(const YamlElement& element) {
  element.allow_keys({"point", "size", "pose"});
  PositionConstraint position;
  if (const std::optional<YamlElement> point = element.find("point")) {
    position.point = point->numbers(3);
  }
  const YamlElement size = element.need("size");
  position.size = size.numbers(3);
  for (const YamlElement& edge : size.items()) {
    if (edge.number() <= 0.0) {
      edge.refuse(edge.found(), "a size above 0 m");
    }
  }
  if (const std::optional<YamlElement> pose = element.find("pose")) {
    position.X_WR = pose_of(*pose);
  }
  return position;
}

/// One entry of a scene file's `constraints`.
/// @param scene with its robots and objects, to which the constraint may refer.
PathConstraint constraint_of(const YamlElement& element, const Scene& scene) {
  element.allow_keys({"name", "body", "upright", "region"});
  PathConstraint constraint;
  const YamlElement name = element.need("name");
  constraint.name = name.text();
  if (constraint.name.empty() ||
      std::ranges::count(scene.constraints, constraint.name, &PathConstraint::name) > 0) {
    name.refuse(name.found() + (constraint.name.empty() ? "" : " a second time"),
                "a name that no other constraint has");
  }
  constraint.body = body_of(element.need("body"), scene);
  const std::optional<YamlElement> upright = element.find("upright");
  const std::optional<YamlElement> region = element.find("region");
  if (upright.has_value() == region.has_value()) {
    element.refuse(upright ? "both upright and region" : "neither upright nor region",
                   "one of upright and region", "Make one constraint for each");
  }
  if (upright) {
    constraint.what = orientation_of(*upright);
  } else {
    constraint.what = position_of(*region);
  }
  return constraint;
}

namespace fs = std::filesystem;

void check_version(const YamlElement& top) {
  const YamlElement version = top.need("handway");
  if (version.number() != kSceneVersion) {
    version.refuse(version.found(), std::to_string(kSceneVersion),
                   "Files of a newer version need a newer Handway");
  }
}

void check_new_name(const YamlElement& element, const Scene& scene, const std::string& name) {
  if (name.empty()) {
    element.refuse("an empty name", "a name");
  }
  if (find_robot_with_part(scene, name) || find_object(scene, name) || find_frame(scene, name)) {
    refuse_second_name(element, name);
  }
}

void add_objects(const YamlElement& list, const fs::path& folder, Scene& scene) {
  for (const YamlElement& element : list.items()) {
    SceneObject object = object_of(element, scene, folder);
    if (const std::optional<YamlElement> mesh = element.find("mesh")) {
      static_cast<void>(find_noted(ResourceKind::kObject, mesh->need("file"), folder, scene));
    }
    check_new_name(element, scene, object.name);
    if (scene.robots.front().model->find_link(object.name)) {
      scene.warnings.push_back("object " + object.name + " has the name of a link of " +
                               scene.robots.front().name);
    }
    scene.display.set(object.name, display_of(element));
    scene.objects.push_back(std::move(object));
  }
}

// Names of bodies that can collide: links of the robots and objects.
std::vector<std::string> names_of_bodies(const Scene& scene) {
  std::vector<std::string> names;
  for (const RobotInstance& robot : scene.robots) {
    const bool is_first = &robot == &scene.robots.front();
    for (const Link& link : robot.model->description().links) {
      names.push_back(is_first ? link.name : robot.name + "/" + link.name);
    }
  }
  std::ranges::transform(scene.objects, std::back_inserter(names), &SceneObject::name);
  return names;
}

// Reads `{allowed: [[a, b], …], checked: [[a, b], …]}`.
void read_collisions(const YamlElement& element, Scene& scene) {
  element.allow_keys({"allowed", "checked"});
  const std::vector<std::string> bodies = names_of_bodies(scene);
  for (const bool allowed : {true, false}) {
    for (const YamlElement& pair : element.items_of(allowed ? "allowed" : "checked")) {
      const std::vector<YamlElement> names = pair.items();
      if (names.size() != 2) {
        pair.refuse(pair.found(), "two names of links or objects");
      }
      for (const YamlElement& name : names) {
        if (std::ranges::count(bodies, name.text()) == 0) {
          name.refuse(name.found(),
                      "a link of the first robot, an object, or ROBOT/LINK of another",
                      advise_name(name.text(), bodies));
        }
      }
      scene.allowed_collisions[std::minmax(names[0].text(), names[1].text())] = allowed;
    }
  }
}

SavedView view_of(const YamlElement& element, const std::vector<SavedView>& known) {
  element.allow_keys({"name", "target", "distance", "azimuth_deg", "elevation_deg"});
  const YamlElement name = element.need("name");
  if (name.text().empty() || std::ranges::count(known, name.text(), &SavedView::name) > 0) {
    name.refuse(name.found() + (name.text().empty() ? "" : " a second time"),
                "a name that no other view has");
  }
  const YamlElement distance = element.need("distance");
  if (distance.number() <= 0.0) {
    distance.refuse(distance.found(), "a distance above 0 m");
  }
  return {name.text(), element.need("target").numbers(3), distance.number(),
          radians(element.need("azimuth_deg").number()),
          radians(element.need("elevation_deg").number())};
}

std::optional<Configuration> query_of(const YamlElement& top, const std::string& key,
                                      const RobotModel& model, const Configuration& defaults) {
  const std::optional<YamlElement> element = top.find(key);
  return element ? std::optional(configuration_of(*element, model, defaults)) : std::nullopt;
}

// Returns the values of joints that a goal does not name: joints that don't move stay at the start.
Configuration goal_defaults(const Scene& scene) {
  const Configuration& stands = scene.robots.front().configuration;
  Configuration defaults = scene.start.value_or(stands);
  for (const int v : moving_variables(scene)) {
    defaults[v] = stands[v];
  }
  return defaults;
}

// One name or a list of them, see Scene::group. @param robots elements of the scene's robots, in
// order; those of robots that the group merges with the first are removed.
void read_group(const YamlElement& element, std::vector<YamlElement>& robots, Scene& scene) {
  std::vector<std::string> group;
  for (const YamlElement& name :
       element.is_list() ? element.items() : std::vector<YamlElement>{element}) {
    group.push_back(name.text());
    if (!is_movable(scene, group.back())) {
      const std::string nearest = nearest_name(group.back(), movable_names(scene));
      name.refuse(name.found(), movable_names_text(scene),
                  nearest.empty() ? "" : "Did you mean \"" + nearest + "\"?");
    }
  }
  if (group.empty()) {
    element.refuse("an empty list", "names of groups, robots or joints that move",
                   "Leave \"group\" out to let all of the first robot move");
  }
  std::vector<std::string> names;
  std::ranges::transform(scene.robots, std::back_inserter(names), &RobotInstance::name);
  set_moving_group(scene, group);
  for (std::size_t i = names.size(); i-- > 0;) {
    if (!find_robot(scene, names[i])) {
      robots.erase(robots.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
}

PlannerRequest planner_of(const YamlElement& element) {
  PlannerRequest planner;
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
                  "goal", "goal_pose", "postures", "views", "hand_basis", "planner", "collisions",
                  "group", "program", "frames"});
  check_version(top);
  const fs::path folder = fs::absolute(file).parent_path();
  Scene scene;
  scene.file = file;
  scene.name = top.text_or("name", "");
  scene.description = top.text_or("description", "");
  std::vector<YamlElement> robots = read_robots(top.need("robots"), folder, scene);
  if (const std::optional<YamlElement> group = top.find("group")) {
    read_group(*group, robots, scene);
  }
  if (const std::optional<YamlElement> objects = top.find("objects")) {
    add_objects(*objects, folder, scene);
  }
  for (const YamlElement& element : top.items_of("frames")) {
    NamedFrame frame = frame_of(element, scene);
    check_new_name(element, scene, frame.name);
    if (scene.robots.front().model->find_link(frame.name)) {
      refuse_second_name(element, frame.name);
    }
    scene.frames.push_back(std::move(frame));
  }
  if (const std::optional<YamlElement> constraints = top.find("constraints")) {
    for (const YamlElement& element : constraints->items()) {
      scene.constraints.push_back(constraint_of(element, scene));
    }
  }
  if (const std::optional<YamlElement> collisions = top.find("collisions")) {
    read_collisions(*collisions, scene);
  }
  const RobotInstance& robot = scene.robots.front();
  scene.start = query_of(top, "start", *robot.model, robot.configuration);
  scene.goal = query_of(top, "goal", *robot.model, goal_defaults(scene));
  if (const std::optional<YamlElement> goals = top.find("goal_pose")) {
    scene.goal_poses = pose_goals_of(*goals, scene);
  }
  bound_bases(robots, scene);
  if (const std::optional<YamlElement> postures = top.find("postures")) {
    for (const auto& [name, values] : postures->entries()) {
      scene.postures.push_back(posture_of(values, *scene.robots.front().model, name));
    }
  }
  for (const YamlElement& element : top.items_of("views")) {
    scene.display.views.push_back(view_of(element, scene.display.views));
  }
  if (const std::optional<YamlElement> basis = top.find("hand_basis")) {
    scene.hand_basis = basis->text();
    static_cast<void>(find_noted(ResourceKind::kHandBasis, *basis, folder, scene));
  }
  if (const std::optional<YamlElement> planner = top.find("planner")) {
    scene.planner = planner_of(*planner);
  }
  if (const std::optional<YamlElement> program = top.find("program")) {
    scene.programs = programs_of(*program, scene);
  }
  return scene;
}

Scene read_objects(const std::string& text, const std::string& source, const Scene& scene) {
  const YamlElement top = YamlElement::parse(text, source, "objects of a scene");
  Scene read;
  read.robots = scene.robots;
  add_objects(top.is_map() ? top.need("objects") : top, fs::current_path(), read);
  read.robots.clear();
  return read;
}

std::vector<PathConstraint> read_constraints(const std::string& text, const std::string& source,
                                             const Scene& scene) {
  Scene read = scene;
  read.constraints.clear();
  for (const YamlElement& element :
       YamlElement::parse(text, source, "constraints of a scene").items()) {
    read.constraints.push_back(constraint_of(element, read));
  }
  return read.constraints;
}

}  // namespace handway::geometric
