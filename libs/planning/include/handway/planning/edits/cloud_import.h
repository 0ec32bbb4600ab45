#pragma once

#include "handway/geometric/io/parameter.h"
#include "handway/geometric/mesh/depth_camera.h"
#include "handway/geometric/mesh/point_cloud.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/robot/robot_state.h"
#include "handway/geometric/scene/scene.h"
#include "handway/geometric/setup/cloud_filters.h"
#include "handway/planning/edits/scene_state.h"
#include "handway/planning/export.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace handway::planning {

/// Settings by which points of a camera become objects of a scene.
struct CloudImport {
  std::string name = "cloud";
  geometric::Pose X_WC = geometric::Pose::Identity();  ///< Pose of the points in the world.
  geometric::CloudCells cells;
  std::optional<geometric::Aabb> box;  ///< Points outside of this box of the world are left out.
  std::optional<geometric::OutlierRule> outliers = geometric::OutlierRule{};
  geometric::BodyFilter bodies;  ///< Bodies whose points are left out.
  /// Tables and what stands on them become primitives, in place of their points: propose_objects().
  bool finds_objects = false;
  /// Camera of a depth image: what its points hide is unknown, and becomes an object as well
  /// (hidden_cells()), within the box or, without one, the bounding box of all points. Nothing:
  /// what is hidden counts as free.
  std::optional<geometric::DepthCamera> hidden_from = {};
};

/// Describes the settings that are a number or a switch, but which points are kept.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<geometric::BoundParameter> parameters_of(
    CloudImport& import);

/// Objects made of points, and what was left out.
struct ImportedCloud {
  /// Objects that were found, then the cloud of all other points, then the hidden space, if there
  /// are any; with names that the scene does not have.
  std::vector<geometric::SceneObject> objects;
  std::size_t points = 0;     ///< Points of the cloud.
  std::size_t outside = 0;    ///< Points outside of the box.
  std::size_t of_bodies = 0;  ///< Points of bodies that are left out.
  std::size_t outliers = 0;
  std::size_t of_found = 0;  ///< Points of the objects that were found.
  std::size_t hidden = 0;    ///< Cells of the hidden space.
};

/// Makes objects of the points that are left after filtering: first those outside of the box go,
/// then those of bodies, then outliers, then those inside of objects that were found or nearer to
/// them than 5 mm. Cells of the hidden space go in the same way.
/// @param scene to which the objects are to be added. @param q configuration of its first robot
/// when the points were taken.
/// @param source of the points, for messages.
/// @throws InputError if no points are left, there are too many cells around them, the radius is
/// too large for the cells, or the scene has no object of a name in `bodies`.
[[nodiscard]] HANDWAY_PLANNING_EXPORT ImportedCloud import_cloud(const geometric::Scene& scene,
                                                                 const geometric::Configuration& q,
                                                                 geometric::PointCloud cloud,
                                                                 const CloudImport& import,
                                                                 const std::string& source);

/// Adds the objects.
[[nodiscard]] HANDWAY_PLANNING_EXPORT SceneState with_cloud(const SceneState& state,
                                                            const ImportedCloud& cloud);

}  // namespace handway::planning
