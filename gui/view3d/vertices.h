#pragma once

#include <Eigen/Core>

#include <span>

class SoVertexProperty;

namespace handway::gui {

/// Points [m, W] for a Coin line or point set.
[[nodiscard]] SoVertexProperty* make_vertices(std::span<const Eigen::Vector3d> points);

}  // namespace handway::gui
