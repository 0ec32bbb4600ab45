#include "model/document/problem_update.h"

#include "handway/geometric/collision/make_checker.h"
#include "model/document/scene_edits.h"

#include <optional>
#include <string>
#include <vector>

namespace handway::gui {
namespace {

using geometric::CollisionWorld;
using geometric::Pose;
using geometric::Scene;
using geometric::SceneObject;
using planning::PlanningProblem;

bool same_pose(const Pose& a, const Pose& b) { return a.matrix() == b.matrix(); }

bool same_robots(const Scene& a, const Scene& b) {
  if (a.robots.size() != b.robots.size()) {
    return false;
  }
  for (std::size_t i = 0; i < a.robots.size(); ++i) {
    const bool stands_as_before = i == 0 || a.robots[i].configuration == b.robots[i].configuration;
    if (a.robots[i].model != b.robots[i].model || a.robots[i].name != b.robots[i].name ||
        !same_pose(a.robots[i].X_WB, b.robots[i].X_WB) || !stands_as_before) {
      return false;
    }
  }
  return true;
}

bool same_attachment(const SceneObject& a, const SceneObject& b) {
  if (!a.attachment || !b.attachment) {
    return !a.attachment && !b.attachment;
  }
  return a.attachment->robot == b.attachment->robot && a.attachment->link == b.attachment->link &&
         a.attachment->touching == b.attachment->touching && same_pose(a.X_PO, b.X_PO);
}

// Objects may move, go, or come at the end, and constraints change; everything else needs a new
// world.
std::optional<CollisionWorld> updated_world(const CollisionWorld& world, const Scene& before,
                                            const Scene& after) {
  CollisionWorld updated = world;
  std::size_t kept = 0;
  for (const SceneObject& old : before.objects) {
    const SceneObject* same = kept < after.objects.size() ? &after.objects[kept] : nullptr;
    if (same && same->name == old.name) {
      if (!same_attachment(old, *same) || !same_shape(old.shape, same->shape) ||
          old.solid != same->solid) {
        return std::nullopt;
      }
      if (!old.attachment && !same_pose(old.X_PO, same->X_PO)) {
        updated = updated.with_object_at(old.name, same->X_PO);
      }
      ++kept;
    } else if (old.attachment) {
      return std::nullopt;
    } else {
      updated = updated.without_object(old.name);
    }
  }
  for (; kept < after.objects.size(); ++kept) {
    const SceneObject& object = after.objects[kept];
    if (object.attachment || geometric::find_object(before, object.name)) {
      return std::nullopt;
    }
    updated = updated.with_object(object);
  }
  return updated.with_constraints_of(after);
}

bool same_world(const Scene& a, const Scene& b) {
  if (a.objects.size() != b.objects.size() || a.constraints != b.constraints) {
    return false;
  }
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    const SceneObject& x = a.objects[i];
    const SceneObject& y = b.objects[i];
    if (x.name != y.name || !same_attachment(x, y) || !same_pose(x.X_PO, y.X_PO) ||
        !same_shape(x.shape, y.shape) || x.solid != y.solid) {
      return false;
    }
  }
  return true;
}

}  // namespace

PlanningProblem updated_problem(const PlanningProblem& before, const planning::LoadedScene& scene,
                                const geometric::Preparation& preparation) {
  if (before.basis != scene.basis || !same_robots(*before.scene, *scene.scene)) {
    return planning::make_problem(scene.scene, scene.basis, preparation);
  }
  PlanningProblem updated = before;
  updated.scene = scene.scene;
  updated.start = scene.scene->start.value();
  updated.goal = scene.scene->goal.value();
  if (same_world(*before.scene, *scene.scene)) {
    return updated;
  }
  std::optional<CollisionWorld> world =
      updated_world(before.checker->world(), *before.scene, *scene.scene);
  if (!world) {
    return planning::make_problem(scene.scene, scene.basis, preparation);
  }
  auto shared = std::make_shared<const CollisionWorld>(std::move(*world));
  updated.motion = std::make_shared<const geometric::MotionBound>(*shared);
  updated.checker = geometric::make_collision_checker(std::move(shared),
                                                      geometric::CheckerKind::kFast, preparation);
  return updated;
}

}  // namespace handway::gui
