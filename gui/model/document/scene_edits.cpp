#include "model/document/scene_edits.h"

#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/setup/moving_group.h"
#include "model/document/selection.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace handway::gui {
using geometric::Configuration;
using geometric::Pose;
using geometric::Scene;
using geometric::SceneObject;

namespace {

// A constraint goes with the object that it is about, also where that is only detached.
SceneState with_scene(const SceneState& state, Scene scene) {
  if (!scene.constraints.empty()) {
    const std::vector<std::string> bodies = constrainable_bodies(scene);
    std::erase_if(scene.constraints, [&](const geometric::PathConstraint& constraint) {
      return std::ranges::count(bodies, constraint.body) == 0;
    });
  }
  SceneState next = state;
  next.scene = std::make_shared<const Scene>(std::move(scene));
  return next;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

bool is_name_used(const Scene& scene, const std::string& name) {
  return geometric::find_object(scene, name) || !owner_of_name(scene, name).empty();
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

namespace {

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

}  // namespace

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

namespace {

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

using Eigen::Vector3d;
using geometric::Aabb;

namespace {

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
    if (contains(names, object.name)) {
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

namespace {

constexpr double kSmallest = 1e-3;  // m
constexpr double kSnap = 0.01;      // m

double new_size(double size, double distance, bool snap) {
  const double wanted = size + distance;
  return std::max(kSmallest, snap ? std::round(wanted / kSnap) * kSnap : wanted);
}

Aabb box_of(const geometric::Shape& shape) {
  return geometric::bounding_box(*geometric::tessellate(shape));
}

struct Pull {
  const ResizeKnob& knob;
  double distance;
  bool snap;
  Pose& X_WO;

  /// One side stays: the centre goes half the way.
  void grow(double& size) const {
    const double grown = new_size(size, distance, snap);
    X_WO.translation() += 0.5 * knob.sign * (grown - size) * Vector3d(X_WO.linear().col(knob.axis));
    size = grown;
  }
  void operator()(geometric::Box& box) const { grow(box.size[knob.axis]); }
  void operator()(geometric::Sphere& sphere) const {
    sphere.radius = new_size(sphere.radius, distance, snap);
  }
  template <typename Round>
  void grow_round(Round& round) const {
    if (knob.axis == 2) {
      grow(round.length);
    } else {
      round.radius = new_size(round.radius, distance, snap);
    }
  }
  void operator()(geometric::Cylinder& cylinder) const { grow_round(cylinder); }
  void operator()(geometric::Cone& cone) const { grow_round(cone); }
  void operator()(geometric::Mesh& mesh) const {
    const Aabb box = box_of(mesh);
    const double size = std::max(box.size()[knob.axis], kSmallest);
    const double factor = new_size(size, distance, false) / size;
    Vector3d fixed = box.centre();
    fixed[knob.axis] -= 0.5 * knob.sign * size;
    X_WO.translation() += X_WO.linear() * ((1.0 - factor) * fixed);
    mesh = scaled(mesh, factor);
  }
};

}  // namespace

std::vector<ResizeKnob> resize_knobs(const geometric::Shape& shape) {
  const Aabb box = box_of(shape);
  std::vector<ResizeKnob> knobs;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int sign : {-1, 1}) {
      ResizeKnob knob{axis, sign, box.centre()};
      knob.p_O[axis] = sign > 0 ? box.upper[axis] : box.lower[axis];
      if (std::holds_alternative<geometric::Cone>(shape) && axis != 2) {
        knob.p_O.z() = box.lower.z();
      }
      knobs.push_back(knob);
    }
  }
  return knobs;
}

Resized resized(const geometric::Shape& shape, const Pose& X_WO, const ResizeKnob& knob,
                double distance, bool snap) {
  Resized result{shape, X_WO};
  std::visit(Pull{knob, distance, snap, result.X_WO}, result.shape);
  return result;
}

geometric::Mesh scaled(const geometric::Mesh& mesh, double factor) {
  geometric::Mesh larger = mesh;
  larger.scale *= factor;
  larger.triangles = std::make_shared<const geometric::TriangleMesh>(
      geometric::transformed(*mesh.triangles, Pose::Identity(), Vector3d::Constant(factor)));
  return larger;
}

namespace {

constexpr double kInContact = 1e-3;
constexpr double kNoMove = 1e-12;

}  // namespace

SceneState dropped(SceneState state, const geometric::Configuration& q,
                   const std::vector<std::string>& names) {
  std::vector<std::vector<std::string>> parts = rigid_parts(*state.scene, names);
  std::ranges::stable_sort(parts, {}, [&](const std::vector<std::string>& part) {
    return bounds(*state.scene, q, part).lower.z();
  });
  for (const std::vector<std::string>& part : parts) {
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

double rise_to_clear(const SceneState& state, const std::vector<std::string>& names) {
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

}  // namespace handway::gui
