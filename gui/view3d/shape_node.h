#pragma once

#include "handway/geometric/mesh/shape.h"
#include "view3d/coin_conversions.h"

#include <Inventor/nodes/SoSeparator.h>

class SoSeparator;
class SoMaterial;

namespace handway::gui {

/// Geometry of `shape` in its own frame, smooth but for its sharp edges.
[[nodiscard]] CoinRef<SoSeparator> make_shape_node(const geometric::Shape& shape);

/// A satin surface of that colour.
[[nodiscard]] CoinRef<SoMaterial> make_material(const geometric::Color& color);

}  // namespace handway::gui
