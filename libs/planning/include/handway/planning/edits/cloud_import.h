#pragma once

#include "handway/geometric/mesh/point_cloud.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/robot/robot_state.h"
#include "handway/geometric/setup/cloud_filters.h"
#include "handway/planning/edits/scene_state.h"
#include "handway/planning/export.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace handway::planning {

/// How points of a camera become an object of a scene.
struct CloudImport {
  std::string name = "cloud";
  geometric::Pose X_WC = geometric::Pose::Identity();  ///< Pose of the points in the world.
  geometric::CloudCells cells;
  std::optional<geometric::Aabb> box;  ///< Points outside of this box of the world are left out.
  std::optional<geometric::OutlierRule> outliers = geometric::OutlierRule{};
  /// Points in the robots, in what they carry, and nearer to them than this (m) are left out.
  std::optional<double> robot_margin = 0.02;
  std::vector<std::string> cut_out;  ///< Objects whose points are left out, too.
};

/// The scene with the object, and what was left out.
struct ImportedCloud {
  SceneState state;
  std::string name;           ///< Of the object: the wanted one, or a similar one.
  std::size_t points = 0;     ///< Points of the object.
  std::size_t outside = 0;    ///< Points outside of the box.
  std::size_t outliers = 0;   ///< Outliers.
  std::size_t of_bodies = 0;  ///< Points of the robots and of the objects that are cut out.
  double seconds = 0.0;       ///< Time that it took.
};

/// Adds the points that are left after filtering as an object: first those outside of the box go,
/// then those of robots and cut-out objects, then outliers.
/// @param q configuration of the first robot when the points were taken.
/// @param source of the points, for messages.
/// @throws InputError if no points are left, there are too many cells around them, or the scene has
/// no object of a name in `cut_out`.
[[nodiscard]] HANDWAY_PLANNING_EXPORT ImportedCloud import_cloud(const SceneState& state,
                                                                 const geometric::Configuration& q,
                                                                 geometric::PointCloud cloud,
                                                                 const CloudImport& import,
                                                                 const std::string& source);

}  // namespace handway::planning
