#pragma once

#include "handway/geometric/scene/color.h"

#include <Eigen/Core>

#include <span>
#include <utility>

class SoSeparator;

namespace handway::gui {

/// Straight lines between points that are given by their numbers.
/// @param points [m, W]
/// @param width of the lines [pixels]
[[nodiscard]] SoSeparator* make_edges_node(std::span<const Eigen::Vector3d> points,
                                           std::span<const std::pair<int, int>> edges,
                                           const geometric::Color& color, float width);

}  // namespace handway::gui
