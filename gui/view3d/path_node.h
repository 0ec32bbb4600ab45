#pragma once

#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/mesh/triangle_mesh.h"
#include "handway/geometric/robot/robot_state.h"
#include "handway/geometric/scene/scene.h"
#include "view3d/overlay.h"

#include <Eigen/Core>

#include <memory>
#include <span>
#include <vector>

namespace handway::gui {

/// A line through `points` (world, m) that changes from the start's colour to
/// the goal's, with a bead at each of `waypoints`; nothing hides it.
[[nodiscard]] Drawing make_path_node(std::span<const Eigen::Vector3d> points,
                                     std::span<const Eigen::Vector3d> waypoints);

/// The colour of the i-th of `count` places along a path, from the start's to the goal's.
[[nodiscard]] geometric::Color color_along(std::size_t i, std::size_t count);

/// A thin line through `points` (world, m) in the same colours, hidden by what is in front.
[[nodiscard]] Drawing make_trail_node(std::span<const Eigen::Vector3d> points);

/// A line of one colour through `points` (world, m): what the robot did. Nothing hides it.
[[nodiscard]] Drawing make_executed_node(std::span<const Eigen::Vector3d> points);

/// The same of a path that is being optimised, with a bead at each of `waypoints`.
[[nodiscard]] Drawing make_optimized_node(std::span<const Eigen::Vector3d> points,
                                          std::span<const Eigen::Vector3d> waypoints);

/// A magenta ball at each of `points` (world, m), seen through everything.
[[nodiscard]] Drawing make_contacts_node(std::span<const Eigen::Vector3d> points);

/// A line between the closest points (world, m) of two bodies, seen through everything: red if
/// they nearly touch, over yellow to green.
[[nodiscard]] Drawing make_clearance_node(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// A thin line through each of `trails` (points in the world, m); see make_trail_node().
[[nodiscard]] Drawing make_trails_node(std::span<const std::vector<Eigen::Vector3d>> trails);

/// The robot, faint, at each of `postures`, from the start's colour to the goal's.
[[nodiscard]] Drawing make_copies_node(const geometric::RobotInstance& robot,
                                       std::span<const geometric::Configuration> postures);

/// A volume (world, m) that things pass through, faint.
[[nodiscard]] Drawing make_volume_node(std::shared_ptr<const geometric::TriangleMesh> mesh);

}  // namespace handway::gui
