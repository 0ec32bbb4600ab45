#include "handway/geometric/setup/moving_group.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/composed_robot.h"
#include "handway/geometric/setup/mounting.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

namespace handway::geometric {
namespace {

JointIndices all_variables(const RobotModel& model) {
  JointIndices all(static_cast<std::size_t>(model.variable_count()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

void sort_once(JointIndices& variables) {
  std::ranges::sort(variables);
  variables.erase(std::unique(variables.begin(), variables.end()), variables.end());
}

// Variables of a group or joint by its name in the whole robot.
JointIndices of_group_or_joint(const RobotModel& model, std::string_view name) {
  JointIndices named = model.find_group(name).value_or(JointIndices{});
  if (named.empty()) {
    if (const std::optional<int> variable = find_variable_of_part(model, name)) {
      named.push_back(*variable);
    }
  }
  return named;
}

// A part's variables in the whole robot.
JointIndices of_part(const RobotModel& whole, const RobotPart& part) {
  JointIndices variables;
  for (const auto& [own, composed] : part.joints) {
    if (const std::optional<int> variable = whole.find_variable(composed)) {
      variables.push_back(*variable);
    }
  }
  return variables;
}

// Finds by the part's own name; else a group of the whole robot, restricted to the part.
JointIndices in_part(const RobotModel& whole, const RobotPart& part, std::string_view name) {
  JointIndices named;
  for (const int variable : of_group_or_joint(*part.model, name)) {
    named.push_back(
        whole.find_variable(part.joints.at(part.model->variable(variable).name)).value());
  }
  if (named.empty()) {
    const JointIndices own = of_part(whole, part);
    std::ranges::copy_if(whole.find_group(name).value_or(JointIndices{}), std::back_inserter(named),
                         [&](int v) { return std::ranges::count(own, v) > 0; });
  }
  return named;
}

// Returns the rest of `name` after "OWNER/"; nothing if it does not begin so.
std::optional<std::string_view> behind(std::string_view name, const std::string& owner) {
  const bool is_its =
      name.size() > owner.size() && name.starts_with(owner) && name[owner.size()] == '/';
  return is_its ? std::optional(name.substr(owner.size() + 1)) : std::nullopt;
}

const RobotInstance* find_owner(const Scene& scene, std::string_view name) {
  const auto owner = std::ranges::find_if(scene.robots, [&](const RobotInstance& robot) {
    return !named_variables(robot, name).empty();
  });
  return owner == scene.robots.end() ? nullptr : &*owner;
}

// The robot becomes a part of the first one, in its place.
void join(Scene& scene, const RobotInstance& robot) {
  const RobotInstance& first = scene.robots.front();
  if (!robot.model->description().base_joints.empty()) {
    throw InputError({scene.file.string(), "group", "robot " + robot.name + ", whose base moves",
                      "the first robot of the scene, or robots whose bases stand",
                      "Put it first in the list of robots"});
  }
  const RobotModel& base = first.parts.empty() ? *first.model : *first.parts.front().model;
  mount_robot(scene, std::string(robot.name), std::string(first.name), base.link(0).name,
              first.X_WB.inverse() * robot.X_WB);
}

}  // namespace

JointIndices named_variables(const RobotInstance& robot, std::string_view name) {
  JointIndices named = of_group_or_joint(*robot.model, name);
  if (named.empty() && robot.parts.empty()) {
    if (robot.name == name) {
      named = all_variables(*robot.model);
    } else if (const auto own = behind(name, robot.name)) {
      named = of_group_or_joint(*robot.model, *own);
    }
  }
  for (auto part = robot.parts.begin(); named.empty() && part != robot.parts.end(); ++part) {
    if (part->name == name) {
      named = of_part(*robot.model, *part);
    } else if (const auto own = behind(name, part->name)) {
      named = in_part(*robot.model, *part, *own);
    }
  }
  sort_once(named);
  return named;
}

JointIndices moving_variables(const Scene& scene) {
  const RobotInstance& robot = scene.robots.front();
  if (scene.group.empty()) {
    return all_variables(*robot.model);
  }
  JointIndices moving;
  for (const std::string& name : scene.group) {
    const JointIndices named = named_variables(robot, name);
    moving.insert(moving.end(), named.begin(), named.end());
  }
  sort_once(moving);
  return moving;
}

std::vector<std::string> movable_names(const Scene& scene) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::ranges::count(names, name) == 0 && is_movable(scene, name)) {
      names.push_back(name);
    }
  };
  const RobotModel& model = *scene.robots.front().model;
  for (const JointGroup& group : model.description().groups) {
    add(group.name);
  }
  for (const RobotInstance& robot : scene.robots) {
    add(robot.name);
    for (const RobotPart& part : robot.parts) {
      add(part.name);
    }
  }
  for (int v = 0; v < model.variable_count(); ++v) {
    add(model.variable(v).name);
  }
  return names;
}

std::string movable_names_text(const Scene& scene) {
  return fmt::format("a group, robot or joint that moves: {}",
                     fmt::join(movable_names(scene), ", "));
}

bool is_movable(const Scene& scene, std::string_view name) {
  return find_owner(scene, name) != nullptr;
}

void keep_still_in_goal(Scene& scene) {
  if (scene.goal) {
    Configuration goal = scene.start.value_or(scene.robots.front().configuration);
    const JointIndices moving = moving_variables(scene);
    goal(moving) = (*scene.goal)(moving);
    scene.goal = goal;
  }
}

void set_moving_group(Scene& scene, const std::vector<std::string>& group) {
  Scene changed = scene;
  for (const std::string& name : group) {
    const RobotInstance* owner = find_owner(changed, name);
    if (owner == nullptr) {
      const std::string nearest = nearest_name(name, movable_names(scene));
      throw InputError({scene.file.string(), "group", "\"" + name + "\"", movable_names_text(scene),
                        nearest.empty() ? "" : "Did you mean \"" + nearest + "\"?"});
    }
    if (owner != &changed.robots.front()) {
      join(changed, *owner);
    }
  }
  changed.group = group;
  keep_still_in_goal(changed);
  scene = std::move(changed);
}

}  // namespace handway::geometric
