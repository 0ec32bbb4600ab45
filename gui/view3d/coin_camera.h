#pragma once

#include <Eigen/Core>

class SoCamera;
class SoOrthographicCamera;
class SoPerspectiveCamera;

/// Coin's cameras, aimed as an OrbitCamera.

namespace handway::gui {

class OrbitCamera;

/// Distances from the camera, m, between which bodies are drawn.
struct EyeRange {
  Eigen::Vector3d position;  ///< Camera position in the world, m.
  double nearest;
  double farthest;
};

/// Returns from where, and between which depths, aim_camera() lets a camera see.
[[nodiscard]] EyeRange eye_range(const OrbitCamera& camera);

/// Sets the position of a Coin camera, and the depths between which it sees.
void set_range(SoCamera& eye, const EyeRange& range);

/// Sets a Coin camera to the pose of `camera`. @param aspect width by height.
void aim_camera(SoPerspectiveCamera& eye, const OrbitCamera& camera, double aspect);

/// Aims an orthographic camera; it stands far back, so that everything is before it.
void aim_camera(SoOrthographicCamera& eye, const OrbitCamera& camera, double aspect);

}  // namespace handway::gui
