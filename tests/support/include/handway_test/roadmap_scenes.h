#pragma once

#include "handway/planning/replanning/dynamic_roadmap.h"

#include <algorithm>
#include <stdexcept>
#include <string>

/// Single changes of the scene that a DynamicRoadmap follows.
namespace handway::test {

/// @param edit changes a scene that has the roadmap's start and goal.
template <typename Edit>
void edit_scene(planning::DynamicRoadmap& roadmap, const Edit& edit) {
  const planning::PlanningProblem& problem = roadmap.problem();
  geometric::Scene scene = *problem.scene;
  scene.start = problem.start;
  scene.goal = problem.goal;
  edit(scene);
  if (!roadmap.follow(scene)) {
    throw std::logic_error("no scene that the roadmap can follow");
  }
}

inline void move_object(planning::DynamicRoadmap& roadmap, const std::string& name,
                        const geometric::Pose& X_WO) {
  edit_scene(roadmap, [&](geometric::Scene& scene) {
    std::ranges::find(scene.objects, name, &geometric::SceneObject::name)->X_PO = X_WO;
  });
}

inline void add_object(planning::DynamicRoadmap& roadmap, const geometric::SceneObject& object) {
  edit_scene(roadmap, [&](geometric::Scene& scene) { scene.objects.push_back(object); });
}

inline void remove_object(planning::DynamicRoadmap& roadmap, const std::string& name) {
  edit_scene(roadmap, [&](geometric::Scene& scene) {
    std::erase_if(scene.objects, [&](const auto& object) { return object.name == name; });
  });
}

inline void set_start(planning::DynamicRoadmap& roadmap, const geometric::Configuration& q) {
  edit_scene(roadmap, [&](geometric::Scene& scene) { scene.start = q; });
}

inline void set_goal(planning::DynamicRoadmap& roadmap, const geometric::Configuration& q) {
  edit_scene(roadmap, [&](geometric::Scene& scene) { scene.goal = q; });
}

}  // namespace handway::test
