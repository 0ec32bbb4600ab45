#pragma once

#include "handway/geometric/math/pose.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "model/document/scene_edits.h"

#include <Eigen/Core>

#include <string>
#include <vector>

/// Arranging several objects, by their bounding boxes along the world's axes. Objects
/// of a group that is named whole keep their places to each other.
namespace handway::gui {

using ObjectNames = std::vector<std::string>;

/// The tight box around objects, the first robot standing at `q`; world, m.
/// @pre names at least one object of the scene.
[[nodiscard]] geometric::Aabb bounds(const geometric::Scene& scene,
                                     const geometric::Configuration& q, const ObjectNames& names);

/// All of them moved by the same motion of the world. @param motion X with p' = X p.
[[nodiscard]] SceneState moved(const SceneState& state, const geometric::Configuration& q,
                               const ObjectNames& names, const geometric::Pose& motion);

/// Which part of the boxes is brought together.
enum class AlignTo { kLeast, kCentre, kMost };

/// All brought to the last one (or the group it is in), along one axis.
[[nodiscard]] SceneState aligned(const SceneState& state, const geometric::Configuration& q,
                                 const ObjectNames& names, int axis, AlignTo to);

/// The same gap between neighbours along one axis; the outermost stay.
[[nodiscard]] SceneState distributed(const SceneState& state, const geometric::Configuration& q,
                                     const ObjectNames& names, int axis);

/// Copies in rows: so many along each axis of the world, so far apart.
struct LinearArray {
  Eigen::Vector3i count{1, 1, 1};          ///< Each at least 1, the original included.
  Eigen::Vector3d spacing{0.1, 0.1, 0.1};  ///< m

  /// Where the copies go, without the original.
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

}  // namespace handway::gui
