#pragma once

class SoPerspectiveCamera;

namespace handway::gui {

class OrbitCamera;

/// Puts a Coin camera where `camera` is. @param aspect width by height.
void aim_camera(SoPerspectiveCamera& eye, const OrbitCamera& camera, double aspect);

}  // namespace handway::gui
