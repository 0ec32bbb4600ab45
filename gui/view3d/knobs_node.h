#pragma once

#include "view3d/coin_ref.h"

#include <Eigen/Core>

#include <optional>
#include <span>

class SoSeparator;

namespace handway::gui {

/// Small squares, always of the same size on the screen. @param points world, m.
/// @param hot index of the one that is under the pointer or held.
[[nodiscard]] CoinRef<SoSeparator> make_knobs_node(std::span<const Eigen::Vector3d> points,
                                                   std::optional<int> hot);

}  // namespace handway::gui
