#include "handway/planning/edits/arranging.h"

#include "handway/geometric/io/input_error.h"
#include "handway/planning/edits/scene_edits.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

namespace handway::planning {

using Eigen::Vector3d;
using geometric::Aabb;
using geometric::Configuration;
using geometric::kRestingGap;
using geometric::Pose;
using geometric::Scene;
using geometric::SceneObject;

namespace {

constexpr double kInContact = 1e-3;  // m
constexpr double kNoMove = 1e-12;    // m

bool is_among(const ObjectNames& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

constexpr double kMostPlaces = 1e6;   // of an array
constexpr double kMostCopies = 1000;  // that are added to a scene at once

void need_at_most(double most, double count) {
  if (!(count >= 1.0 && count <= most)) {
    throw geometric::InputError(
        {"array", "", fmt::format("{:.0f} objects", count), fmt::format("1 to {:.0f}", most), ""});
  }
}

Pose shift_along(int axis, double distance) {
  return Pose(Eigen::Translation3d(distance * Vector3d::Unit(axis)));
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

ObjectNames group_members(const geometric::Scene& scene, const std::string& group) {
  ObjectNames members;
  for (const geometric::SceneObject& object : scene.objects) {
    if (!group.empty() && scene.display.of(object.name).group == group) {
      members.push_back(object.name);
    }
  }
  return members;
}

std::vector<ObjectNames> rigid_parts(const geometric::Scene& scene, const ObjectNames& objects) {
  std::vector<ObjectNames> parts;
  ObjectNames done;
  for (const std::string& name : objects) {
    if (is_among(done, name)) {
      continue;
    }
    const ObjectNames group = group_members(scene, scene.display.of(name).group);
    const bool whole = !group.empty() && std::ranges::all_of(group, [&](const std::string& member) {
      return is_among(objects, member);
    });
    parts.push_back(whole ? group : ObjectNames{name});
    done.insert(done.end(), parts.back().begin(), parts.back().end());
  }
  return parts;
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

Vector3d shift_to_sides(const Scene& scene, const Configuration& q, const ObjectNames& names,
                        double reach) {
  const Aabb box = bounds(scene, q, names);
  Vector3d shift = Vector3d::Constant(reach);
  const auto offer = [&](int axis, double step) {
    shift[axis] = std::abs(step) < std::abs(shift[axis]) ? step : shift[axis];
  };
  for (const SceneObject& object : scene.objects) {
    if (is_among(names, object.name)) {
      continue;
    }
    const Aabb other = bounds(scene, q, {object.name});
    for (int axis = 0; axis < 3; ++axis) {
      offer(axis, other.lower[axis] - box.lower[axis]);
      offer(axis, other.upper[axis] - box.upper[axis]);
      offer(axis, other.lower[axis] - kRestingGap - box.upper[axis]);
      offer(axis, other.upper[axis] + kRestingGap - box.lower[axis]);
    }
  }
  offer(2, -box.lower.z());
  return (shift.array() < reach).select(shift, 0.0);
}

std::vector<Pose> LinearArray::motions() const {
  need_at_most(kMostPlaces, (count.array() < 1).any() ? 0.0 : count.cast<double>().prod());
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
  need_at_most(kMostPlaces, count);
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
  need_at_most(kMostCopies, static_cast<double>(names.size() * (motions.size() + 1)));
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

Copies with_objects_of(const SceneState& state, const Scene& added, const Pose& motion) {
  Scene scene = *state.scene;
  ObjectNames made;
  std::map<std::string, std::string> groups;
  for (SceneObject object : added.objects) {
    geometric::ObjectDisplay display = added.display.of(object.name);
    if (!display.group.empty()) {
      const auto [known, is_new] = groups.try_emplace(display.group);
      if (is_new) {
        known->second = unused_group(scene, display.group);
      }
      display.group = known->second;
    }
    object.name = unused_name(scene, object.name);
    if (!object.attachment) {
      object.X_PO = motion * object.X_PO;
    }
    scene.display.set(object.name, std::move(display));
    made.push_back(object.name);
    scene.objects.push_back(std::move(object));
  }
  return {{std::make_shared<const Scene>(std::move(scene))}, made};
}

Scene objects_alone(const SceneState& state, const Configuration& q, const ObjectNames& names) {
  Scene alone;
  for (const std::string& name : names) {
    SceneObject object = *state.find(name);
    object.X_PO = object_pose(*state.scene, q, object);
    object.attachment.reset();
    geometric::ObjectDisplay display = state.display_of(name);
    display.locked = false;
    alone.display.set(name, std::move(display));
    alone.objects.push_back(std::move(object));
  }
  return alone;
}

SceneState dropped(SceneState state, const Configuration& q, const ObjectNames& names) {
  for (const std::string& name : names) {
    const SceneObject* object = state.find(name);
    if (object != nullptr && object->attachment) {
      throw geometric::InputError({source_of(*state.scene), "",
                                   "\"" + name + "\", which is attached to a link",
                                   "an object that stands in the world", "Detach it first"});
    }
  }
  std::vector<ObjectNames> parts = rigid_parts(*state.scene, names);
  std::ranges::stable_sort(
      parts, {}, [&](const ObjectNames& part) { return bounds(*state.scene, q, part).lower.z(); });
  for (const ObjectNames& part : parts) {
    const SceneState others = without_objects(state, part);
    double height = std::numeric_limits<double>::infinity();
    for (const std::string& name : part) {
      const SceneObject& object = *state.find(name);
      height = std::min(height, height_above_floor(object));
      if (const auto gap = gap_to_support(*others.scene, object)) {
        height = std::min(height, *gap - kRestingGap);
      }
    }
    if (std::abs(height) > kNoMove) {
      state = moved(state, q, part, Pose(Eigen::Translation3d(0.0, 0.0, -height)));
    }
  }
  return state;
}

ObjectNames sunk_into(const geometric::Scene& scene, const ObjectNames& names) {
  const auto is_named = [&](const SceneObject& object) {
    return std::ranges::find(names, object.name) != names.end();
  };
  const auto in_world = [](const SceneObject& object) {
    return transformed(*tessellate(object.shape), object.X_PO);
  };
  std::vector<geometric::TriangleMesh> own;
  for (const SceneObject& object : scene.objects) {
    if (is_named(object) && !object.attachment) {
      own.push_back(in_world(object));
    }
  }
  ObjectNames found;
  for (const SceneObject& object : scene.objects) {
    if (is_named(object) || object.attachment) {
      continue;
    }
    const geometric::TriangleMesh other = in_world(object);
    if (std::ranges::any_of(own, [&](const geometric::TriangleMesh& mesh) {
          return vertical_gap(mesh, other).value_or(0.0) < -kInContact;
        })) {
      found.push_back(object.name);
    }
  }
  return found;
}

double rise_to_clear(const SceneState& state, const ObjectNames& names) {
  const SceneState others = without_objects(state, names);
  double rise = 0.0;
  for (const std::string& name : names) {
    const SceneObject& object = *state.find(name);
    const auto gap = object.attachment ? std::nullopt : gap_to_support(*others.scene, object);
    if (gap && *gap >= -kInContact) {
      rise = std::max(rise, kRestingGap - *gap);
    }
  }
  return rise > kNoMove ? rise : 0.0;
}

SceneState attached(const SceneState& state, const Configuration& q, const ObjectNames& names,
                    const LinkOfRobot& on, const std::vector<std::string>& touching) {
  const std::optional<Pose> X_WL = link_pose(*state.scene, q, on.robot, on.link);
  if (!X_WL) {
    throw geometric::InputError({source_of(*state.scene), "",
                                 "the link \"" + on.link + "\" of \"" + on.robot + "\"",
                                 "a link of a robot of the scene", ""});
  }
  const Eigen::Translation3d rise(0.0, 0.0, rise_to_clear(state, names));
  return with_changed_objects(state, names, [&](SceneObject& object) {
    object.X_PO = X_WL->inverse() * rise * object_pose(*state.scene, q, object);
    object.attachment = geometric::Attachment{on.robot, on.link, touching};
  });
}

SceneState detached(const SceneState& state, const Configuration& q, const ObjectNames& names) {
  return with_changed_objects(state, names, [&](SceneObject& object) {
    object.X_PO = object_pose(*state.scene, q, object);
    object.attachment.reset();
  });
}

}  // namespace handway::planning
