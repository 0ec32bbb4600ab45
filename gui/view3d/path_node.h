#pragma once

#include "handway/geometric/scene/color.h"
#include "view3d/coin_ref.h"

#include <Eigen/Core>

#include <span>

class SoSeparator;

namespace handway::gui {

/// A line through `points` (world, m) that changes from the start's colour to
/// the goal's, with a bead at each of `waypoints`; nothing hides it.
[[nodiscard]] CoinRef<SoSeparator> make_path_node(std::span<const Eigen::Vector3d> points,
                                                  std::span<const Eigen::Vector3d> waypoints);

/// The colour of the i-th of `count` places along a path, from the start's to the goal's.
[[nodiscard]] geometric::Color color_along(std::size_t i, std::size_t count);

/// A thin line through `points` (world, m) in the same colours, hidden by what is in front.
[[nodiscard]] CoinRef<SoSeparator> make_trail_node(std::span<const Eigen::Vector3d> points);

/// A line of one colour through `points` (world, m): what the robot did. Nothing hides it.
[[nodiscard]] CoinRef<SoSeparator> make_executed_node(std::span<const Eigen::Vector3d> points);

/// The same of a path that is being optimised, with a bead at each of `waypoints`.
[[nodiscard]] CoinRef<SoSeparator> make_optimized_node(std::span<const Eigen::Vector3d> points,
                                                       std::span<const Eigen::Vector3d> waypoints);

/// A magenta ball at each of `points` (world, m), seen through everything.
[[nodiscard]] CoinRef<SoSeparator> make_contacts_node(std::span<const Eigen::Vector3d> points);

/// A line between the closest points (world, m) of two bodies, seen through everything: red if
/// they nearly touch, over yellow to green.
[[nodiscard]] CoinRef<SoSeparator> make_clearance_node(const Eigen::Vector3d& a,
                                                       const Eigen::Vector3d& b);

}  // namespace handway::gui
