#include "view3d/coin_camera.h"

#include "model/settings/orbit_camera.h"
#include "view3d/coin_conversions.h"

#include <Inventor/nodes/SoOrthographicCamera.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>

#include <algorithm>

namespace handway::gui {
namespace {

constexpr double kReach = 12.0;  // m: what is shown behind the target

void turn(SoCamera& eye, const OrbitCamera& camera, double aspect) {
  eye.viewportMapping = SoCamera::LEAVE_ALONE;
  eye.aspectRatio = static_cast<float>(aspect);
  eye.orientation = to_coin_rotation(camera.orientation());
}

}  // namespace

EyeRange eye_range(const OrbitCamera& camera) {
  const double distance = camera.placement().distance;
  if (camera.projection() == Projection::kOrthographic) {
    const Eigen::Vector3d backwards = camera.orientation().col(2);
    return {camera.placement().target + kReach * backwards, 0.01, 2.0 * kReach};
  }
  return {camera.position(), std::max(0.01, 0.05 * distance), distance + kReach};
}

void set_range(SoCamera& eye, const EyeRange& range) {
  eye.position = to_coin(range.position);
  eye.nearDistance = static_cast<float>(range.nearest);
  eye.farDistance = static_cast<float>(range.farthest);
}

void aim_camera(SoPerspectiveCamera& eye, const OrbitCamera& camera, double aspect) {
  turn(eye, camera, aspect);
  set_range(eye, eye_range(camera));
  eye.heightAngle = static_cast<float>(OrbitCamera::kFieldOfView);
  eye.focalDistance = static_cast<float>(camera.placement().distance);
}

void aim_camera(SoOrthographicCamera& eye, const OrbitCamera& camera, double aspect) {
  turn(eye, camera, aspect);
  set_range(eye, eye_range(camera));
  eye.height = static_cast<float>(camera.seen_height(camera.placement().distance));
  eye.focalDistance = static_cast<float>(kReach);
}

}  // namespace handway::gui
