#pragma once

#include "view3d/drawing.h"

#include <Eigen/Core>

#include <span>

namespace handway::gui {

/// Draws a line between the closest points (world, m) of two bodies, seen through everything: red
/// if they nearly touch, over yellow to green.
[[nodiscard]] Drawing make_clearance_node(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// Draws a measured line through `points` (world, m), with a dot at each, seen through everything.
[[nodiscard]] Drawing make_measure_node(std::span<const Eigen::Vector3d> points);

}  // namespace handway::gui
