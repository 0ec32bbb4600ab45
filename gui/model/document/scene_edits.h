#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/scene/scene.h"
#include "handway/geometric/setup/placing.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Arranging several objects, by their bounding boxes along the world's axes. Objects
/// of a group that is named whole keep their places to each other.

namespace handway::gui {

using geometric::kRestingGap;

/// State of a scene that is edited. It is immutable: an edit makes a new state of an old
/// one.
struct SceneState {
  std::shared_ptr<const geometric::Scene> scene;
  std::shared_ptr<const sampling::PmdBasis> basis = nullptr;  ///< Basis of the hand, or null.

  [[nodiscard]] bool is_hidden(std::string_view object) const { return display_of(object).hidden; }
  [[nodiscard]] bool is_locked(std::string_view object) const { return display_of(object).locked; }
  [[nodiscard]] geometric::ObjectDisplay display_of(std::string_view object) const {
    return scene ? scene->display.of(object) : geometric::ObjectDisplay{};
  }
  /// nullptr if there is no such object.
  [[nodiscard]] const geometric::SceneObject* find(std::string_view object) const {
    return scene ? geometric::find_object(*scene, object) : nullptr;
  }

  friend bool operator==(const SceneState&, const SceneState&) = default;
};

using ObjectChange = std::function<void(geometric::SceneObject&)>;
using DisplayChange = std::function<void(geometric::ObjectDisplay&)>;

/// The robot that is called so, or has a link that is; empty: there is none.
[[nodiscard]] std::string owner_of_name(const geometric::Scene& scene, const std::string& name);

/// `name`, or `name` with the first number that makes it unlike all other names:
/// "can", "can 2", "can 3", ….
[[nodiscard]] std::string unused_name(const geometric::Scene& scene, const std::string& name);

/// @param object gets an unused name.
[[nodiscard]] SceneState with_object(const SceneState& state, geometric::SceneObject object);
/// Constraints about them go, too.
[[nodiscard]] SceneState without_objects(const SceneState& state,
                                         const std::vector<std::string>& names);
/// @param change of anything but the name. Constraints about what is detached go.
[[nodiscard]] SceneState with_changed_object(const SceneState& state, std::string_view name,
                                             const ObjectChange& change);
[[nodiscard]] SceneState with_changed_objects(const SceneState& state,
                                              const std::vector<std::string>& names,
                                              const ObjectChange& change);
/// @param change of how the window treats each of these objects.
[[nodiscard]] SceneState with_changed_display(const SceneState& state,
                                              const std::vector<std::string>& names,
                                              const DisplayChange& change);
[[nodiscard]] SceneState with_renamed_object(const SceneState& state, const std::string& name,
                                             const std::string& new_name);
/// Adds a constraint, or replaces the one of that name. @param constraint about one of
/// constrainable_bodies().
[[nodiscard]] SceneState with_constraint(const SceneState& state,
                                         geometric::PathConstraint constraint);
[[nodiscard]] SceneState without_constraint(const SceneState& state, std::string_view name);
/// `name`, or the first like it that no constraint has.
[[nodiscard]] std::string unused_constraint_name(const geometric::Scene& scene,
                                                 const std::string& name);
[[nodiscard]] SceneState with_base(const SceneState& state, std::string_view robot,
                                   const geometric::Pose& X_WB);
/// The goal keeps to the start in what does not move.
[[nodiscard]] SceneState with_start(const SceneState& state, const geometric::Configuration& q);
[[nodiscard]] SceneState with_goal(const SceneState& state, const geometric::Configuration& q);
/// The goal pose of that number changed, or, one after the last, a new one.
[[nodiscard]] SceneState with_goal_pose(const SceneState& state, std::size_t index,
                                        const geometric::PoseGoal& goal);
[[nodiscard]] SceneState without_goal_pose(const SceneState& state, std::size_t index);
/// Adds a posture, or replaces the one of that name.
[[nodiscard]] SceneState with_posture(const SceneState& state,
                                      const geometric::NamedPosture& posture);
[[nodiscard]] SceneState without_posture(const SceneState& state, std::string_view name);
/// Adds `view`, or replaces the view of that name.
[[nodiscard]] SceneState with_saved_view(const SceneState& state, const geometric::SavedView& view);
[[nodiscard]] SceneState without_saved_view(const SceneState& state, std::string_view name);
/// The hand is planned for with a basis, which the scene names by its file.
[[nodiscard]] SceneState with_basis(const SceneState& state, const std::filesystem::path& file,
                                    std::shared_ptr<const sampling::PmdBasis> basis);

/// `group`, or the first like it that no object is in: "group", "group 2", ….
[[nodiscard]] std::string unused_group(const geometric::Scene& scene, const std::string& group);

/// Returns the pose in the world of a constrained body, with the first robot at `q`; nothing if it
/// is none of constrainable_bodies().
[[nodiscard]] std::optional<geometric::Pose> body_pose(const geometric::Scene& scene,
                                                       const geometric::Configuration& q,
                                                       std::string_view body);

/// The body's axis that is nearest to the vertical at `q` stays within 10° of it.
/// @pre the body is one of constrainable_bodies().
[[nodiscard]] geometric::PathConstraint new_upright(const geometric::Scene& scene,
                                                    const geometric::Configuration& q,
                                                    const std::string& body);
/// The body's origin stays in a box with room around where it is at `q`, at start and at goal.
/// @pre the body is one of constrainable_bodies().
[[nodiscard]] geometric::PathConstraint new_region(const geometric::Scene& scene,
                                                   const geometric::Configuration& q,
                                                   const std::string& body);

using ObjectNames = std::vector<std::string>;

/// All of them moved by the same motion of the world. @param motion X with p' = X p.
[[nodiscard]] SceneState moved(const SceneState& state, const geometric::Configuration& q,
                               const ObjectNames& names, const geometric::Pose& motion);

/// Part of the boxes that is aligned.
enum class AlignTo { kLeast, kCentre, kMost };

/// All brought to the last one (or the group it is in), along one axis.
[[nodiscard]] SceneState aligned(const SceneState& state, const geometric::Configuration& q,
                                 const ObjectNames& names, int axis, AlignTo to);

/// Makes the gaps between neighbours along one axis equal; the outermost objects stay.
[[nodiscard]] SceneState distributed(const SceneState& state, const geometric::Configuration& q,
                                     const ObjectNames& names, int axis);

/// Returns the shift of objects such that, along each axis of the world, a side of the box around
/// them meets the nearest side of the box around another object, or the floor (z = 0): flush with
/// it, or kRestingGap beside it. It is 0 along an axis without one within `reach`.
[[nodiscard]] Eigen::Vector3d shift_to_sides(const geometric::Scene& scene,
                                             const geometric::Configuration& q,
                                             const ObjectNames& names, double reach);

/// Copies in rows: so many along each axis of the world, so far apart.
struct LinearArray {
  Eigen::Vector3i count{1, 1, 1};          ///< Each at least 1, the original included.
  Eigen::Vector3d spacing{0.1, 0.1, 0.1};  ///< m

  /// Returns the motions to the copies, without the original.
  [[nodiscard]] std::vector<geometric::Pose> motions() const;
};

/// Copies around an axis of the world.
struct CircularArray {
  int count = 6;                                     ///< The original included.
  int axis = 2;                                      ///< x, y, z
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< m
  double angle = 0.0;   ///< From the first to the last, rad; a full turn: evenly around.
  bool turning = true;  ///< The copies turn along.

  /// @param p_W what is copied, where it does not turn along.
  [[nodiscard]] std::vector<geometric::Pose> motions(const Eigen::Vector3d& p_W) const;
};

/// A state with copies, and what they are called.
struct Copies {
  SceneState state;
  ObjectNames names;
};

/// One copy of all objects for each motion. A copied group becomes a group of its own.
[[nodiscard]] Copies copied(const SceneState& state, const geometric::Configuration& q,
                            const ObjectNames& names, const std::vector<geometric::Pose>& motions);

/// The objects of `added`, which stand in the world, moved by one motion of the world; under names
/// and in groups that are unused.
[[nodiscard]] Copies with_objects_of(const SceneState& state, const geometric::Scene& added,
                                     const geometric::Pose& motion);

/// Returns a scene of these objects alone, with their poses in the world, unlocked, to be added to
/// this or another scene.
[[nodiscard]] geometric::Scene objects_alone(const SceneState& state,
                                             const geometric::Configuration& q,
                                             const ObjectNames& names);

/// A face of a shape that can be pulled outwards: of a box or mesh each of its six sides, of
/// a cylinder or cone its ends and its mantle, of a sphere anywhere on the axes.
struct ResizeKnob {
  int axis = 0;  ///< Axis of the shape's own frame.
  int sign = 1;  ///< On which side.
  Eigen::Vector3d p_O = Eigen::Vector3d::Zero();

  friend bool operator==(const ResizeKnob& a, const ResizeKnob& b) {
    return a.axis == b.axis && a.sign == b.sign;
  }
};

[[nodiscard]] std::vector<ResizeKnob> resize_knobs(const geometric::Shape& shape);

/// A shape of another size, and where it is then.
struct Resized {
  geometric::Shape shape;
  geometric::Pose X_WO;
};

/// Pulls one knob outwards. The opposite side stays, but radii grow around the axis, and a
/// mesh grows in all directions alike. Nothing gets smaller than 1 mm.
/// @param distance m. @param snap to sizes (of meshes: none) in whole centimetres.
[[nodiscard]] Resized resized(const geometric::Shape& shape, const geometric::Pose& X_WO,
                              const ResizeKnob& knob, double distance, bool snap);

/// The mesh with each coordinate `factor` times as large.
[[nodiscard]] geometric::Mesh scaled(const geometric::Mesh& mesh, double factor);

/// The objects sunk or lifted until they stand kRestingGap above other objects, or on the
/// floor (z = 0). Objects of a group that is named whole move together.
/// @param names of objects that stand in the world.
[[nodiscard]] SceneState dropped(SceneState state, const geometric::Configuration& q,
                                 const std::vector<std::string>& names);

/// Returns by how much all objects together are to be raised so that those that stand in the world
/// keep kRestingGap to their support; m. Objects that are sunk into it by more than 1 mm do not
/// rest there, and objects in a link's frame are held: neither counts.
[[nodiscard]] double rise_to_clear(const SceneState& state, const std::vector<std::string>& names);

}  // namespace handway::gui
