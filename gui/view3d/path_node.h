#pragma once

#include "view3d/coin_ref.h"

#include <Eigen/Core>

#include <span>

class SoSeparator;

namespace handway::gui {

/// A line through `points` (world, m) that changes from the start's colour to
/// the goal's, with a bead at each of `waypoints`; nothing hides it.
[[nodiscard]] CoinRef<SoSeparator> make_path_node(std::span<const Eigen::Vector3d> points,
                                                  std::span<const Eigen::Vector3d> waypoints);

/// A line of one colour through `points` (world, m): what the robot did. Nothing hides it.
[[nodiscard]] CoinRef<SoSeparator> make_executed_node(std::span<const Eigen::Vector3d> points);

/// A dot at each of `points` (world, m).
[[nodiscard]] CoinRef<SoSeparator> make_dots_node(std::span<const Eigen::Vector3d> points);

/// A magenta ball at each of `points` (world, m), seen through everything.
[[nodiscard]] CoinRef<SoSeparator> make_contacts_node(std::span<const Eigen::Vector3d> points);

}  // namespace handway::gui
