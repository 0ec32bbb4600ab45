#include "handway/geometric/scene/scene_difference.h"

#include <algorithm>
#include <string>
#include <variant>

namespace handway::geometric {
namespace {

struct SameShape {
  bool operator()(const Box& a, const Box& b) const { return a.size == b.size; }
  bool operator()(const Sphere& a, const Sphere& b) const { return a.radius == b.radius; }
  bool operator()(const Cylinder& a, const Cylinder& b) const {
    return a.radius == b.radius && a.length == b.length;
  }
  bool operator()(const Cone& a, const Cone& b) const {
    return a.radius == b.radius && a.length == b.length;
  }
  bool operator()(const Mesh& a, const Mesh& b) const {
    return a.triangles == b.triangles && a.scale == b.scale;
  }
  bool operator()(const Cloud& a, const Cloud& b) const { return a.surface == b.surface; }
  template <typename A, typename B>
  bool operator()(const A& /*a*/, const B& /*b*/) const {
    return false;
  }
};

bool same_pose(const Pose& a, const Pose& b) { return a.matrix() == b.matrix(); }

bool same_robots(const Scene& a, const Scene& b) {
  return std::ranges::equal(a.robots, b.robots, [&](const auto& x, const auto& y) {
    const bool is_first = &x == &a.robots.front();
    return x.model == y.model && x.name == y.name && same_pose(x.X_WB, y.X_WB) &&
           x.padding == y.padding && (is_first || x.configuration == y.configuration);
  });
}

bool same_body(const SceneObject& a, const SceneObject& b) {
  return same_shape(a.shape, b.shape) && a.solid == b.solid;
}

bool same_carried(const Scene& a, const Scene& b) {
  const auto carried = [](const Scene& scene) {
    std::vector<const SceneObject*> found;
    for (const SceneObject& object : scene.objects) {
      if (object.attachment) {
        found.push_back(&object);
      }
    }
    return found;
  };
  return std::ranges::equal(carried(a), carried(b), [](const SceneObject* x, const SceneObject* y) {
    return x->name == y->name && x->attachment->robot == y->attachment->robot &&
           x->attachment->link == y->attachment->link &&
           x->attachment->touching == y->attachment->touching && same_pose(x->X_PO, y->X_PO) &&
           same_body(*x, *y);
  });
}

std::vector<ObjectChange> changes_of_still_objects(const Scene& before, const Scene& after) {
  std::vector<ObjectChange> changes;
  for (const SceneObject& old : before.objects) {
    if (old.attachment) {
      continue;
    }
    const SceneObject* now = find_object(after, old.name);
    if (!now || !same_body(old, *now)) {
      changes.push_back({ObjectChange::Kind::kRemoved, old});
    } else if (!same_pose(old.X_PO, now->X_PO)) {
      changes.push_back({ObjectChange::Kind::kMoved, *now});
    }
  }
  for (const SceneObject& now : after.objects) {
    const SceneObject* old = find_object(before, now.name);
    if (!now.attachment && (!old || !same_body(*old, now))) {
      changes.push_back({ObjectChange::Kind::kAdded, now});
    }
  }
  return changes;
}

}  // namespace

bool same_shape(const Shape& a, const Shape& b) { return std::visit(SameShape{}, a, b); }

std::optional<SceneDifference> scene_difference(const Scene& before, const Scene& after) {
  if (!same_robots(before, after) || !same_carried(before, after) ||
      before.allowed_collisions != after.allowed_collisions) {
    return std::nullopt;
  }
  SceneDifference difference;
  difference.changes = changes_of_still_objects(before, after);
  difference.other_constraints = before.constraints != after.constraints;
  difference.other_group = before.group != after.group;
  Scene changed;
  changed.objects = before.objects;
  for (const ObjectChange& change : difference.changes) {
    apply(change, changed);
  }
  difference.keeps_order = std::ranges::equal(changed.objects, after.objects, {},
                                              &SceneObject::name, &SceneObject::name);
  return difference;
}

void apply(const ObjectChange& change, Scene& scene) {
  const auto place = std::ranges::find(scene.objects, change.object.name, &SceneObject::name);
  switch (change.kind) {
    case ObjectChange::Kind::kMoved:
      place->X_PO = change.object.X_PO;
      break;
    case ObjectChange::Kind::kRemoved:
      scene.objects.erase(place);
      break;
    case ObjectChange::Kind::kAdded:
      scene.objects.push_back(change.object);
  }
}

}  // namespace handway::geometric
