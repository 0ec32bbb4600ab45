#include "model/document/arrange.h"

#include "model/document/scene_edits.h"
#include "model/document/selection.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace handway::gui {

using Eigen::Vector3d;
using geometric::Aabb;
using geometric::Configuration;
using geometric::Pose;
using geometric::Scene;
using geometric::SceneObject;

namespace {

Pose shift_along(int axis, double distance) {
  return Pose(Eigen::Translation3d(distance * Vector3d::Unit(axis)));
}

Aabb box_of(const Scene& scene, const Configuration& q, const SceneObject& object) {
  return geometric::bounding_box(
      geometric::transformed(*geometric::tessellate(object.shape), object_pose(scene, q, object)));
}

double place_in(const Aabb& box, int axis, AlignTo to) {
  switch (to) {
    case AlignTo::kLeast:
      return box.lower[axis];
    case AlignTo::kMost:
      return box.upper[axis];
    case AlignTo::kCentre:
      break;
  }
  return box.centre()[axis];
}

}  // namespace

Aabb bounds(const Scene& scene, const Configuration& q, const ObjectNames& names) {
  Aabb whole{Vector3d::Constant(HUGE_VAL), Vector3d::Constant(-HUGE_VAL)};
  for (const std::string& name : names) {
    if (const SceneObject* object = geometric::find_object(scene, name)) {
      const Aabb box = box_of(scene, q, *object);
      whole.lower = whole.lower.cwiseMin(box.lower);
      whole.upper = whole.upper.cwiseMax(box.upper);
    }
  }
  return whole;
}

SceneState moved(const SceneState& state, const Configuration& q, const ObjectNames& names,
                 const Pose& motion) {
  return with_changed_objects(state, names, [&](SceneObject& object) {
    object.X_PO = in_parent(*state.scene, q, object, motion * object_pose(*state.scene, q, object));
  });
}

SceneState aligned(const SceneState& state, const Configuration& q, const ObjectNames& names,
                   int axis, AlignTo to) {
  const std::vector<ObjectNames> parts = rigid_parts(*state.scene, names);
  const auto is_last = [&](const ObjectNames& part) {
    return std::ranges::find(part, names.back()) != part.end();
  };
  const auto last = std::ranges::find_if(parts, is_last);
  const double wanted = place_in(bounds(*state.scene, q, *last), axis, to);
  SceneState next = state;
  for (const ObjectNames& part : parts) {
    const double here = place_in(bounds(*state.scene, q, part), axis, to);
    if (!is_last(part) && here != wanted) {
      next = moved(next, q, part, shift_along(axis, wanted - here));
    }
  }
  return next;
}

SceneState distributed(const SceneState& state, const Configuration& q, const ObjectNames& names,
                       int axis) {
  std::vector<std::pair<Aabb, ObjectNames>> parts;
  double filled = 0.0;
  for (ObjectNames& part : rigid_parts(*state.scene, names)) {
    const Aabb box = bounds(*state.scene, q, part);
    filled += box.size()[axis];
    parts.emplace_back(box, std::move(part));
  }
  if (parts.size() < 3) {
    return state;
  }
  std::ranges::stable_sort(parts, {},
                           [axis](const auto& part) { return part.first.centre()[axis]; });
  const double gap = (parts.back().first.upper[axis] - parts.front().first.lower[axis] - filled) /
                     static_cast<double>(parts.size() - 1);
  SceneState next = state;
  double from = parts.front().first.upper[axis] + gap;
  for (std::size_t i = 1; i + 1 < parts.size(); ++i) {
    const auto& [box, part] = parts[i];
    next = moved(next, q, part, shift_along(axis, from - box.lower[axis]));
    from += box.size()[axis] + gap;
  }
  return next;
}

std::vector<Pose> LinearArray::motions() const {
  std::vector<Pose> motions;
  for (int z = 0; z < count.z(); ++z) {
    for (int y = 0; y < count.y(); ++y) {
      for (int x = 0; x < count.x(); ++x) {
        if (x + y + z > 0) {
          motions.emplace_back(Eigen::Translation3d(Vector3d(x, y, z).cwiseProduct(spacing)));
        }
      }
    }
  }
  return motions;
}

std::vector<Pose> CircularArray::motions(const Vector3d& p_W) const {
  constexpr double kNearlyFull = 2.0 * std::numbers::pi - 1e-6;
  const int steps = std::abs(angle) >= kNearlyFull ? count : std::max(count - 1, 1);
  std::vector<Pose> motions;
  for (int i = 1; i < count; ++i) {
    const Pose turn = Eigen::Translation3d(centre) *
                      Pose(Eigen::AngleAxisd(i * angle / steps, Vector3d::Unit(axis))) *
                      Eigen::Translation3d(-centre);
    motions.push_back(turning ? turn : Pose(Eigen::Translation3d(turn * p_W - p_W)));
  }
  return motions;
}

Copies copied(const SceneState& state, const Configuration& q, const ObjectNames& names,
              const std::vector<Pose>& motions) {
  Scene scene = *state.scene;
  ObjectNames made;
  const std::vector<ObjectNames> parts = rigid_parts(*state.scene, names);
  for (const Pose& motion : motions) {
    for (const ObjectNames& part : parts) {
      std::string group;
      if (part.size() > 1) {
        group = unused_group(scene, state.display_of(part.front()).group);
      }
      for (const std::string& name : part) {
        SceneObject copy = *state.find(name);
        copy.X_PO = in_parent(*state.scene, q, copy, motion * object_pose(*state.scene, q, copy));
        copy.name = unused_name(scene, name);
        geometric::ObjectDisplay display = state.display_of(name);
        display.group = part.size() > 1 ? group : display.group;
        display.locked = false;
        scene.display.set(copy.name, std::move(display));
        made.push_back(copy.name);
        scene.objects.push_back(std::move(copy));
      }
    }
  }
  return {{std::make_shared<const Scene>(std::move(scene))}, made};
}

}  // namespace handway::gui
