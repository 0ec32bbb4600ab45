#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/geometric/scene/scene.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// Positions of things in a scene, their supports, and free space for more.
namespace handway::geometric {

/// Pose of a robot's link in the world, with the first robot at `q`. Nothing if there is no such
/// link.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<Pose> link_pose(const Scene& scene,
                                                                     const Configuration& q,
                                                                     std::string_view robot,
                                                                     std::string_view link);

/// Pose of an object in the world, with the first robot at `q`.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Pose object_pose(const Scene& scene, const Configuration& q,
                                                        const SceneObject& object);

/// `X_WO` in the frame of `object`'s placement: the world, or its link.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Pose in_parent(const Scene& scene, const Configuration& q,
                                                      const SceneObject& object, const Pose& X_WO);

/// The tight box around objects, with the first robot at `q`; world, m.
/// @pre names at least one object of the scene.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Aabb bounds(const Scene& scene, const Configuration& q,
                                                   const std::vector<std::string>& names);

/// Distance that `upper` can sink along -z until it touches `lower`; both in the
/// world. Negative if it must be lifted because they overlap. Nothing if they are
/// not above each other anywhere. Exact for triangles: the least vertical
/// distance is at a vertex over a face, a face over a vertex, or where two edges
/// cross in the view from above. Parts of `lower` above the middle of `upper` are
/// ignored.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<double> vertical_gap(
    const TriangleMesh& upper, const TriangleMesh& lower);

/// The least vertical gap between an object that is fixed to the world and objects of the scene
/// below it, m; negative where they overlap. Nothing if it is above none.
/// @param scene attached objects, and an object of that name, are ignored.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<double> gap_to_support(
    const Scene& scene, const SceneObject& object);

/// Height of the lowest point of an object that is fixed to the world above the floor (z = 0), m.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT double height_above_floor(const SceneObject& object);

/// Gap between an object that was dropped and its support, m.
inline constexpr double kRestingGap = 0.5e-3;

/// Finds a free place (world, m) for the middle of the underside of a box along the world's axes,
/// so that nothing is in the box: no object, no robot as it is shown, and not the first one at
/// start or goal. It is the nearest place beside `wanted`, at its height if an object is below it
/// there, or else dropped as far as it falls, at whole 5 mm along x and y. It keeps kRestingGap to
/// its support and some millimetres to the rest.
/// @param size of the box, m.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Eigen::Vector3d free_foot(const Scene& scene,
                                                                 const Configuration& q,
                                                                 const Eigen::Vector3d& size,
                                                                 const Eigen::Vector3d& wanted);

/// Returns the motion that brings objects to be added into free space as a whole, as free_foot()
/// does; floating objects stay at their height.
/// @param added a scene with them, which may be `scene` itself: then they go beside themselves.
/// @param names at least one object of `added`.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Pose motion_into_free(const Scene& scene,
                                                             const Configuration& q,
                                                             const Scene& added,
                                                             const std::vector<std::string>& names);

}  // namespace handway::geometric
