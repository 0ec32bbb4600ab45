#include "handway/geometric/scene/scene.h"

#include <algorithm>

namespace handway::geometric {
namespace {

template <typename Items>
auto find_named(const Items& items, std::string_view name) -> decltype(items.data()) {
  const auto found = std::ranges::find_if(items, [&](const auto& i) { return i.name == name; });
  return found == items.end() ? nullptr : &*found;
}

}  // namespace

const RobotInstance* find_robot(const Scene& scene, std::string_view name) {
  return find_named(scene.robots, name);
}

const SceneObject* find_object(const Scene& scene, std::string_view name) {
  return find_named(scene.objects, name);
}

const NamedFrame* find_frame(const Scene& scene, std::string_view name) {
  return find_named(scene.frames, name);
}

std::optional<Pose> standing_pose(const Scene& scene, std::string_view name) {
  if (const NamedFrame* frame = find_frame(scene, name)) {
    if (frame->parent.empty()) {
      return frame->X_PF;
    }
    const SceneObject* parent = find_object(scene, frame->parent);
    return parent && !parent->attachment ? std::optional(parent->X_PO * frame->X_PF) : std::nullopt;
  }
  const SceneObject* object = find_object(scene, name);
  return object && !object->attachment ? std::optional(object->X_PO) : std::nullopt;
}

std::vector<std::string> standing_names(const Scene& scene) {
  std::vector<std::string> names;
  const auto add_standing = [&](const auto& items) {
    for (const auto& item : items) {
      if (standing_pose(scene, item.name)) {
        names.push_back(item.name);
      }
    }
  };
  add_standing(scene.objects);
  add_standing(scene.frames);
  return names;
}

const RobotInstance* find_robot_with_part(const Scene& scene, std::string_view name) {
  const auto has_it = [&](const RobotInstance& robot) {
    return robot.name == name || std::ranges::count(robot.parts, name, &RobotPart::name) > 0;
  };
  const auto found = std::ranges::find_if(scene.robots, has_it);
  return found == scene.robots.end() ? nullptr : &*found;
}

bool is_carried_by(const SceneObject& object, const RobotInstance& robot) {
  return object.attachment && object.attachment->robot == robot.name &&
         robot.model->find_link(object.attachment->link);
}

void remove_objects(Scene& scene, const std::vector<std::string>& names) {
  const auto is_named = [&](const std::string& body) {
    return std::ranges::find(names, body) != names.end();
  };
  std::erase_if(scene.objects, [&](const SceneObject& object) { return is_named(object.name); });
  std::erase_if(scene.frames, [&](const NamedFrame& frame) { return is_named(frame.parent); });
  for (const std::string& name : names) {
    scene.display.remove(name);
  }
  // A file can't refer to a body that is gone.
  std::erase_if(scene.allowed_collisions, [&](const auto& entry) {
    return is_named(entry.first.first) || is_named(entry.first.second);
  });
  std::erase_if(scene.constraints, [&](const PathConstraint& constraint) {
    return is_named(constraint.body) && !scene.robots.front().model->find_link(constraint.body);
  });
}

void follow_objects(const Scene& before, Scene& after) {
  for (PoseGoal& goal : after.goal_poses) {
    const std::optional<Pose> now = standing_pose(after, goal.reference);
    const std::optional<Pose> old = standing_pose(before, goal.reference);
    if (!now) {
      goal.reference.clear();
    } else if (old && old->matrix() != now->matrix()) {
      goal.X_WG = *now * old->inverse() * goal.X_WG;
    }
    const NamedFrame* tool = find_frame(after, goal.tool);
    if (tool && tool->parent == goal.link) {
      goal.X_LT = tool->X_PF;
    } else {
      goal.tool.clear();
    }
  }
}

std::vector<std::string> constrainable_bodies(const Scene& scene) {
  const RobotInstance& robot = scene.robots.front();
  std::vector<std::string> bodies;
  for (const SceneObject& object : scene.objects) {
    if (is_carried_by(object, robot)) {
      bodies.push_back(object.name);
    }
  }
  for (const Link& link : robot.model->description().links) {
    bodies.push_back(link.name);
  }
  return bodies;
}

}  // namespace handway::geometric
