#pragma once

#include "handway/geometric/scene/scene.h"
#include "model/settings/orbit_camera.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

/// Viewpoints of a scene, and the points that have to be visible.
namespace handway::gui {

/// Points (world, m) that a picture of the scene should contain: corners around
/// every link of every robot as it stands, of the first robot also at start and
/// goal, and around the parts of objects that are close to the robots.
[[nodiscard]] std::vector<Eigen::Vector3d> points_of_interest(const geometric::Scene& scene);

/// The lowest height that any robot or object reaches, m; 0 for an empty scene.
[[nodiscard]] double lowest_point(const geometric::Scene& scene);

/// Azimuth (rad, about +z from +x) from the first robot's base to where its last
/// link is at goal, or to where it stands if there is no goal.
[[nodiscard]] double task_azimuth(const geometric::Scene& scene);

/// Corners of the boxes around everything in the scene (world, m).
[[nodiscard]] std::vector<Eigen::Vector3d> all_points(const geometric::Scene& scene);

/// Initial view of a scene.
struct OpeningView {
  OrbitCamera camera;
  /// Point (world, m) in front of which, towards the camera, objects have to be cut away to see the
  /// robots that they hide; nothing if enough of them is visible.
  std::optional<Eigen::Vector3d> section = std::nullopt;
};

/// Looks across the task, obliquely, with much of the robots visible past shelves and the walls of
/// cages, and all of interest in view. If objects enclose the robots on all sides, the view shows
/// them behind a section plane. @param camera its projection is kept. @param aspect width by
/// height.
[[nodiscard]] OpeningView open_view(const geometric::Scene& scene, const OrbitCamera& camera,
                                    double aspect);

}  // namespace handway::gui
