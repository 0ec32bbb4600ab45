#pragma once

#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/scene/scene.h"
#include "view3d/drawing.h"

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace handway::gui {

/// Returns the colour of the i-th of `count` places along a path, from the start's to the goal's.
[[nodiscard]] geometric::Color color_along(std::size_t i, std::size_t count);

/// Draws a line through `points` (world, m) that changes from the start's colour to the goal's,
/// with a bead at each of `waypoints`; nothing hides it.
[[nodiscard]] Drawing make_path_node(std::span<const Eigen::Vector3d> points,
                                     std::span<const Eigen::Vector3d> waypoints);

/// Draws a thin line through `points` (world, m) in the colours from start to goal, hidden by what
/// is in front.
[[nodiscard]] Drawing make_trail_node(std::span<const Eigen::Vector3d> points);

/// Draws a thin line through each of `trails` (points in the world, m); see make_trail_node().
[[nodiscard]] Drawing make_trails_node(std::span<const std::vector<Eigen::Vector3d>> trails);

/// Draws the motion that the robot executed: a line of one colour through `points` (world, m).
/// Nothing hides it.
[[nodiscard]] Drawing make_executed_node(std::span<const Eigen::Vector3d> points);

/// Draws a path that is being optimised, with a bead at each of `waypoints`.
[[nodiscard]] Drawing make_optimized_node(std::span<const Eigen::Vector3d> points,
                                          std::span<const Eigen::Vector3d> waypoints);

/// Draws the robot, faint, at each of `postures`, from the start's colour to the goal's.
[[nodiscard]] Drawing make_copies_node(const geometric::RobotInstance& robot,
                                       std::span<const geometric::Configuration> postures);

/// Draws a volume (world, m) that bodies pass through, faint.
[[nodiscard]] Drawing make_volume_node(std::shared_ptr<const geometric::TriangleMesh> mesh);

}  // namespace handway::gui
