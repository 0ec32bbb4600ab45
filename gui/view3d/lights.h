#pragma once

#include "view3d/coin_ref.h"

class SoGroup;

namespace handway::gui {

/// Key and fill light that go with the camera; belongs before it in the graph.
[[nodiscard]] CoinRef<SoGroup> make_camera_lights();

/// A weak light from above, standing in the world; belongs after the camera.
[[nodiscard]] CoinRef<SoGroup> make_sky_light();

}  // namespace handway::gui
