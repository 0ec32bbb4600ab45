#pragma once

#include "handway/geometric/mesh/shape.h"
#include "view3d/coin_conversions.h"

#include <Eigen/Core>

class SoSeparator;

namespace handway::gui {

/// Lines 0.1 m apart on a horizontal disc, stronger every 0.5 m, fading out
/// towards its rim.
/// @param centre of the disc in the world, m. @param radius m.
[[nodiscard]] CoinRef<SoSeparator> make_floor_grid(const Eigen::Vector3d& centre, double radius,
                                                   const geometric::Color& color);

}  // namespace handway::gui
