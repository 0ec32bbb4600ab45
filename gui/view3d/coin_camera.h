#pragma once

class SoOrthographicCamera;
class SoPerspectiveCamera;

namespace handway::gui {

class OrbitCamera;

/// Puts a Coin camera where `camera` is. @param aspect width by height.
void aim_camera(SoPerspectiveCamera& eye, const OrbitCamera& camera, double aspect);

/// The same for one that sees in parallel; it stands far back, so that everything is before it.
void aim_camera(SoOrthographicCamera& eye, const OrbitCamera& camera, double aspect);

}  // namespace handway::gui
