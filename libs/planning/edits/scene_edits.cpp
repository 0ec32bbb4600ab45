#include "handway/planning/edits/scene_edits.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/setup/moving_group.h"
#include "handway/geometric/setup/placing.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace handway::planning {

using geometric::Configuration;
using geometric::Pose;
using geometric::Scene;
using geometric::SceneObject;

namespace {

// A constraint goes with the object that it is about, also where that is only detached; goal poses
// move with theirs.
SceneState with_scene(const SceneState& state, Scene scene) {
  if (!scene.constraints.empty()) {
    const std::vector<std::string> bodies = constrainable_bodies(scene);
    std::erase_if(scene.constraints, [&](const geometric::PathConstraint& constraint) {
      return std::ranges::count(bodies, constraint.body) == 0;
    });
  }
  follow_objects(*state.scene, scene);
  SceneState next = state;
  next.scene = std::make_shared<const Scene>(std::move(scene));
  return next;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

bool is_name_used(const Scene& scene, const std::string& name) {
  return geometric::find_object(scene, name) || geometric::find_frame(scene, name) ||
         !owner_of_name(scene, name).empty();
}

// `name`, or its stem with the first number from 2 on that is not used.
template <typename IsUsed>
std::string unlike_others(const std::string& name, const IsUsed& is_used) {
  if (!is_used(name)) {
    return name;
  }
  std::string stem = name;
  const std::size_t space = name.find_last_of(' ');
  if (space != std::string::npos && space + 1 < name.size() &&
      std::all_of(name.begin() + static_cast<std::ptrdiff_t>(space) + 1, name.end(),
                  [](char c) { return c >= '0' && c <= '9'; })) {
    stem = name.substr(0, space);
  }
  int number = 2;
  while (is_used(stem + " " + std::to_string(number))) {
    ++number;
  }
  return stem + " " + std::to_string(number);
}

std::map<geometric::AllowedCollisions::Pair, bool> pairs_with_name(
    const std::map<geometric::AllowedCollisions::Pair, bool>& allowed_collisions,
    const std::string& name, const std::string& new_name) {
  const auto now = [&](const std::string& body) { return body == name ? new_name : body; };
  std::map<geometric::AllowedCollisions::Pair, bool> pairs;
  for (const auto& [pair, touch] : allowed_collisions) {
    pairs[std::minmax(now(pair.first), now(pair.second))] = touch;
  }
  return pairs;
}

// In place of the one of that name, or as the last.
template <typename Named>
void put(std::vector<Named>& all, const Named& one) {
  const auto same = std::ranges::find(all, one.name, &Named::name);
  if (same != all.end()) {
    *same = one;
  } else {
    all.push_back(one);
  }
}

}  // namespace

std::string owner_of_name(const Scene& scene, const std::string& name) {
  for (const geometric::RobotInstance& robot : scene.robots) {
    if (robot.name == name || robot.model->find_link(name)) {
      return robot.name;
    }
  }
  return {};
}

std::string unused_name(const Scene& scene, const std::string& name) {
  return unlike_others(name, [&](const std::string& word) { return is_name_used(scene, word); });
}

std::string unused_group(const Scene& scene, const std::string& group) {
  return unlike_others(group, [&](const std::string& word) {
    return std::ranges::any_of(scene.objects, [&](const SceneObject& object) {
      return scene.display.of(object.name).group == word;
    });
  });
}

std::string source_of(const Scene& scene) {
  if (!scene.file.empty()) {
    return scene.file.string();
  }
  return scene.name.empty() ? "scene" : "scene " + scene.name;
}

const SceneObject& need_object(const Scene& scene, std::string_view name) {
  if (const SceneObject* object = geometric::find_object(scene, name)) {
    return *object;
  }
  std::vector<std::string> there;
  std::ranges::transform(scene.objects, std::back_inserter(there), &SceneObject::name);
  throw geometric::InputError({source_of(scene), "", "the object \"" + std::string(name) + "\"",
                               "an object of the scene", geometric::advise_name(name, there)});
}

void need_objects(const Scene& scene, const std::vector<std::string>& names) {
  if (names.empty()) {
    throw geometric::InputError({source_of(scene), "objects", "none", "at least one", ""});
  }
  for (const std::string& name : names) {
    need_object(scene, name);
  }
}

SceneState with_object(const SceneState& state, SceneObject object) {
  Scene scene = *state.scene;
  object.name = unused_name(scene, object.name);
  scene.objects.push_back(std::move(object));
  return with_scene(state, std::move(scene));
}

SceneState without_objects(const SceneState& state, const std::vector<std::string>& names) {
  Scene scene = *state.scene;
  geometric::remove_objects(scene, names);
  return with_scene(state, std::move(scene));
}

SceneState with_changed_object(const SceneState& state, std::string_view name,
                               const ObjectChange& change) {
  return with_changed_objects(state, {std::string(name)}, change);
}

SceneState with_changed_objects(const SceneState& state, const std::vector<std::string>& names,
                                const ObjectChange& change) {
  Scene scene = *state.scene;
  for (SceneObject& object : scene.objects) {
    if (contains(names, object.name)) {
      change(object);
    }
  }
  return with_scene(state, std::move(scene));
}

SceneState with_changed_display(const SceneState& state, const std::vector<std::string>& names,
                                const DisplayChange& change) {
  Scene scene = *state.scene;
  for (const SceneObject& object : scene.objects) {
    if (contains(names, object.name)) {
      geometric::ObjectDisplay display = scene.display.of(object.name);
      change(display);
      scene.display.set(object.name, std::move(display));
    }
  }
  return with_scene(state, std::move(scene));
}

SceneState with_renamed_object(const SceneState& state, const std::string& name,
                               const std::string& new_name) {
  Scene scene = *state.scene;
  for (SceneObject& object : scene.objects) {
    if (object.name != name) {
      continue;
    }
    object.name = new_name;
    scene.display.remove(name);
    scene.display.set(new_name, state.display_of(name));
    scene.allowed_collisions = pairs_with_name(scene.allowed_collisions, name, new_name);
    geometric::rename_object(scene.programs, name, new_name);
    for (geometric::PoseGoal& goal : scene.goal_poses) {
      goal.reference = goal.reference == name ? new_name : goal.reference;
    }
    for (geometric::NamedFrame& frame : scene.frames) {
      frame.parent = frame.parent == name ? new_name : frame.parent;
    }
    if (is_carried_by(object, scene.robots.front())) {  // if not, they are about a link
      for (geometric::PathConstraint& constraint : scene.constraints) {
        constraint.body = constraint.body == name ? new_name : constraint.body;
      }
    }
  }
  return with_scene(state, std::move(scene));
}

SceneState with_constraint(const SceneState& state, geometric::PathConstraint constraint) {
  Scene scene = *state.scene;
  const auto same =
      std::ranges::find(scene.constraints, constraint.name, &geometric::PathConstraint::name);
  if (same != scene.constraints.end()) {
    *same = std::move(constraint);
  } else {
    scene.constraints.push_back(std::move(constraint));
  }
  return with_scene(state, std::move(scene));
}

SceneState without_constraint(const SceneState& state, std::string_view name) {
  Scene scene = *state.scene;
  std::erase_if(scene.constraints, [&](const geometric::PathConstraint& constraint) {
    return constraint.name == name;
  });
  return with_scene(state, std::move(scene));
}

std::string unused_constraint_name(const Scene& scene, const std::string& name) {
  return unlike_others(name, [&](const std::string& word) {
    return std::ranges::count(scene.constraints, word, &geometric::PathConstraint::name) > 0;
  });
}

SceneState with_base(const SceneState& state, std::string_view robot, const Pose& X_WB) {
  Scene scene = *state.scene;
  for (geometric::RobotInstance& instance : scene.robots) {
    if (instance.name == robot) {
      instance.X_WB = X_WB;
    }
  }
  return with_scene(state, std::move(scene));
}

SceneState with_start(const SceneState& state, const Configuration& q) {
  Scene scene = *state.scene;
  scene.start = q;
  geometric::keep_still_in_goal(scene);
  return with_scene(state, std::move(scene));
}

SceneState with_goal(const SceneState& state, const Configuration& q) {
  Scene scene = *state.scene;
  scene.start = scene.start.value_or(scene.robots.front().configuration);
  scene.goal = q;
  scene.goal_poses.clear();
  geometric::keep_still_in_goal(scene);
  return with_scene(state, std::move(scene));
}

SceneState with_goal_pose(const SceneState& state, std::size_t index,
                          const geometric::PoseGoal& goal) {
  Scene scene = *state.scene;
  if (index < scene.goal_poses.size()) {
    scene.goal_poses[index] = goal;
  } else {
    scene.goal_poses.push_back(goal);
  }
  return with_scene(state, std::move(scene));
}

SceneState without_goal_pose(const SceneState& state, std::size_t index) {
  Scene scene = *state.scene;
  scene.goal_poses.erase(scene.goal_poses.begin() + static_cast<std::ptrdiff_t>(index));
  return with_scene(state, std::move(scene));
}

void check_frame(const Scene& scene, const geometric::NamedFrame& frame) {
  const bool is_known = geometric::find_frame(scene, frame.name) != nullptr;
  if (frame.name.empty() || (!is_known && is_name_used(scene, frame.name))) {
    throw geometric::InputError(
        {source_of(scene), "frame",
         frame.name.empty() ? "an empty name" : "the name \"" + frame.name + "\", which is used",
         "a name that no robot, link, object or other frame has", ""});
  }
  if (frame.parent.empty() || geometric::find_object(scene, frame.parent)) {
    return;
  }
  if (scene.robots.empty() || !scene.robots.front().model->find_link(frame.parent)) {
    throw geometric::InputError({source_of(scene), "frame " + frame.name,
                                 "the parent \"" + frame.parent + "\"",
                                 "an object, or a link of the first robot", ""});
  }
}

SceneState with_frame(const SceneState& state, const geometric::NamedFrame& frame) {
  check_frame(*state.scene, frame);
  Scene scene = *state.scene;
  put(scene.frames, frame);
  return with_scene(state, std::move(scene));
}

SceneState without_frame(const SceneState& state, std::string_view name) {
  Scene scene = *state.scene;
  std::erase_if(scene.frames,
                [&](const geometric::NamedFrame& frame) { return frame.name == name; });
  return with_scene(state, std::move(scene));
}

SceneState with_renamed_frame(const SceneState& state, const std::string& name,
                              const std::string& new_name) {
  Scene scene = *state.scene;
  for (geometric::NamedFrame& frame : scene.frames) {
    frame.name = frame.name == name ? new_name : frame.name;
  }
  for (geometric::PoseGoal& goal : scene.goal_poses) {
    goal.reference = goal.reference == name ? new_name : goal.reference;
    goal.tool = goal.tool == name ? new_name : goal.tool;
  }
  geometric::rename_object(scene.programs, name, new_name);
  return with_scene(state, std::move(scene));
}

std::optional<Pose> frame_pose(const Scene& scene, const Configuration& q,
                               const geometric::NamedFrame& frame) {
  if (frame.parent.empty()) {
    return frame.X_PF;
  }
  if (const SceneObject* object = geometric::find_object(scene, frame.parent)) {
    return object_pose(scene, q, *object) * frame.X_PF;
  }
  const auto X_WL = link_pose(scene, q, scene.robots.front().name, frame.parent);
  return X_WL ? std::optional(*X_WL * frame.X_PF) : std::nullopt;
}

SceneState with_posture(const SceneState& state, const geometric::NamedPosture& posture) {
  Scene scene = *state.scene;
  put(scene.postures, posture);
  return with_scene(state, std::move(scene));
}

SceneState without_posture(const SceneState& state, std::string_view name) {
  Scene scene = *state.scene;
  std::erase_if(scene.postures,
                [&](const geometric::NamedPosture& posture) { return posture.name == name; });
  return with_scene(state, std::move(scene));
}

SceneState with_saved_view(const SceneState& state, const geometric::SavedView& view) {
  Scene scene = *state.scene;
  put(scene.display.views, view);
  return with_scene(state, std::move(scene));
}

SceneState without_saved_view(const SceneState& state, std::string_view name) {
  Scene scene = *state.scene;
  std::erase_if(scene.display.views,
                [&](const geometric::SavedView& view) { return view.name == name; });
  return with_scene(state, std::move(scene));
}

SceneState with_basis(const SceneState& state, const std::filesystem::path& file,
                      std::shared_ptr<const sampling::PmdBasis> basis) {
  Scene scene = *state.scene;
  scene.hand_basis = file;
  SceneState next = with_scene(state, std::move(scene));
  next.basis = std::move(basis);
  return next;
}

std::optional<Pose> body_pose(const Scene& scene, const Configuration& q, std::string_view body) {
  const SceneObject* object = geometric::find_object(scene, body);
  if (object && is_carried_by(*object, scene.robots.front())) {
    return object_pose(scene, q, *object);
  }
  return link_pose(scene, q, scene.robots.front().name, body);
}

geometric::PathConstraint new_upright(const Scene& scene, const Configuration& q,
                                      const std::string& body) {
  geometric::OrientationConstraint upright;
  const Eigen::Vector3d up = body_pose(scene, q, body)->linear().transpose().col(2);
  Eigen::Index nearest = 0;
  up.cwiseAbs().maxCoeff(&nearest);
  upright.axis = Eigen::Vector3d::Unit(nearest) * std::copysign(1.0, up[nearest]);
  return {unused_constraint_name(scene, body + " upright"), body, upright};
}

geometric::PathConstraint new_region(const Scene& scene, const Configuration& q,
                                     const std::string& body) {
  constexpr double kRoom = 0.1;  // m, on each side
  Eigen::AlignedBox3d box;
  for (const Configuration& at : {q, scene.start.value_or(q), scene.goal.value_or(q)}) {
    box.extend(body_pose(scene, at, body)->translation());
  }
  geometric::PositionConstraint region;
  region.size = (box.sizes().array() + 2.0 * kRoom).matrix();
  region.X_WR.translation() = box.center();
  return {unused_constraint_name(scene, "region of " + body), body, region};
}

}  // namespace handway::planning
