#pragma once

#include "collision/nearest_point.h"

namespace handway::geometric {

using TriangleCorners = std::array<Eigen::Vector3d, 3>;

/// Below this (m) surfaces count as touching unless FCL says otherwise: a hair,
/// so that roundings can't hide a touch.
inline constexpr double kTouch = 1e-9;

/// Does the plane of one triangle keep the other at least `tolerance` (m) away?
/// Says no where it can't tell.
[[nodiscard]] bool plane_keeps_apart(const TriangleCorners& s, const TriangleCorners& t,
                                     double tolerance);

/// Does an edge of one go through the other, at least kTouch from its borders?
/// Then they collide however that is counted.
[[nodiscard]] bool surely_cross(const TriangleCorners& s, const TriangleCorners& t);

}  // namespace handway::geometric
