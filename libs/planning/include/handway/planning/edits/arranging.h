#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/scene/scene.h"
#include "handway/geometric/setup/placing.h"
#include "handway/planning/edits/robot_edits.h"
#include "handway/planning/edits/scene_state.h"
#include "handway/planning/export.h"

#include <Eigen/Core>

#include <string>
#include <vector>

/// @file
/// Arrangement of several objects by their bounding boxes along the world's axes. Objects of a
/// group that is named whole keep their places to each other. `q` is the first robot's
/// configuration, which moves attached objects.

namespace handway::planning {

/// Names of objects of a scene.
using ObjectNames = std::vector<std::string>;

/// Returns the objects of a group, in the scene's order.
[[nodiscard]] HANDWAY_PLANNING_EXPORT ObjectNames group_members(const geometric::Scene& scene,
                                                                const std::string& group);

/// Returns the objects in parts that move as one: each group that is named whole, and each other
/// object by itself; in the order of `objects`.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<ObjectNames> rigid_parts(
    const geometric::Scene& scene, const ObjectNames& objects);

/// Moves objects by one motion of the world. @param motion X with p' = X p.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState moved(const SceneState& state,
                                                       const geometric::Configuration& q,
                                                       const ObjectNames& names,
                                                       const geometric::Pose& motion);

/// Side of the bounding boxes that is aligned.
enum class AlignTo { kLeast, kCentre, kMost };

/// Aligns objects with the last one, or its group, along one axis.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState aligned(const SceneState& state,
                                                         const geometric::Configuration& q,
                                                         const ObjectNames& names, int axis,
                                                         AlignTo to);

/// Makes the gaps between neighbours along one axis equal; the outermost objects stay.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState distributed(const SceneState& state,
                                                             const geometric::Configuration& q,
                                                             const ObjectNames& names, int axis);

/// Returns the shift of objects such that, along each axis of the world, a side of the box around
/// them meets the nearest side of the box around another object, or the floor (z = 0): flush with
/// it, or kRestingGap beside it. It is 0 along an axis without one within `reach`.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Eigen::Vector3d shift_to_sides(
    const geometric::Scene& scene, const geometric::Configuration& q, const ObjectNames& names,
    double reach);

/// An array of copies in rows along the axes of the world.
struct HANDWAY_PLANNING_EXPORT LinearArray {
  Eigen::Vector3i count{1, 1, 1};          ///< Numbers of objects, the original included; ≥ 1.
  Eigen::Vector3d spacing{0.1, 0.1, 0.1};  ///< Distances of neighbours, m.

  /// Returns the motions to the copies, without the original.
  /// @throws InputError for more than 1e6 places, or less than one.
  [[nodiscard]] std::vector<geometric::Pose> motions() const;
};

/// An array of copies around an axis of the world.
struct HANDWAY_PLANNING_EXPORT CircularArray {
  int count = 6;                                     ///< Number of objects, the original included.
  int axis = 2;                                      ///< 0, 1, 2: x, y, z.
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< A point of the axis, m.
  double angle = 0.0;   ///< From the first to the last one, rad; a full turn spreads them evenly.
  bool turning = true;  ///< Whether the copies turn along.

  /// Returns the motions to the copies, without the original.
  /// @param p_W position of the original, for copies that do not turn along.
  /// @throws InputError for more than 1e6 places, or less than one.
  [[nodiscard]] std::vector<geometric::Pose> motions(const Eigen::Vector3d& p_W) const;
};

/// A scene with copies, and their names.
struct Copies {
  SceneState state;
  ObjectNames names;
};

/// Adds one copy of all objects for each motion. A copied group becomes a group of its own.
/// @throws InputError for more than 1,000 objects, the originals included.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Copies copied(const SceneState& state,
                                                    const geometric::Configuration& q,
                                                    const ObjectNames& names,
                                                    const std::vector<geometric::Pose>& motions);

/// Adds the objects of another scene, moved by one motion of the world, under names and in groups
/// that are unused. @param added scene whose objects stand in the world.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Copies with_objects_of(const SceneState& state,
                                                             const geometric::Scene& added,
                                                             const geometric::Pose& motion);

/// Returns a scene of these objects alone, with their poses in the world, unlocked, to be added to
/// this or another scene.
[[nodiscard]] HANDWAY_PLANNING_EXPORT geometric::Scene objects_alone(
    const SceneState& state, const geometric::Configuration& q, const ObjectNames& names);

/// Lowers or lifts objects until they stand kRestingGap above other objects, or on the floor
/// (z = 0). Objects of a group that is named whole move together.
/// @param names of objects that stand in the world.
/// @throws InputError if one of them is attached to a link.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState dropped(SceneState state,
                                                         const geometric::Configuration& q,
                                                         const ObjectNames& names);

/// Returns the other fixed objects that objects reach into by more than 1 mm, as seen from above;
/// see geometric::vertical_gap(). Attached objects count nowhere.
[[nodiscard]] HANDWAY_PLANNING_EXPORT ObjectNames sunk_into(const geometric::Scene& scene,
                                                            const ObjectNames& names);

/// Returns by how much all objects together are to be raised so that those that stand in the world
/// keep kRestingGap to their support; m. Objects that are sunk into it by more than 1 mm do not
/// rest there, and objects in a link's frame are held: neither counts.
[[nodiscard]] HANDWAY_PLANNING_EXPORT double rise_to_clear(const SceneState& state,
                                                           const ObjectNames& names);

/// Attaches objects to a link, at the poses in the world that they have at `q`. Objects that rest
/// on something are raised by rise_to_clear(): they could not be moved at all otherwise.
/// @param on a robot of the scene and one of its links, by the name in the robot's model.
/// @param touching links that may touch the objects.
/// @throws InputError if there is no such robot or link.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState attached(const SceneState& state,
                                                          const geometric::Configuration& q,
                                                          const ObjectNames& names,
                                                          const LinkOfRobot& on,
                                                          const std::vector<std::string>& touching);

/// Detaches objects: they stay in the world at the poses that they have at `q`.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState detached(const SceneState& state,
                                                          const geometric::Configuration& q,
                                                          const ObjectNames& names);

}  // namespace handway::planning
