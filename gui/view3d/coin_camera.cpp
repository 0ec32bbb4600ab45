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
  const Eigen::Matrix3f R = camera.orientation().cast<float>();
  SbMatrix turn = SbMatrix::identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      turn[row][column] = R(column, row);
    }
  }
  eye.viewportMapping = SoCamera::LEAVE_ALONE;
  eye.aspectRatio = static_cast<float>(aspect);
  eye.orientation = SbRotation(turn);
}

}  // namespace

void aim_camera(SoPerspectiveCamera& eye, const OrbitCamera& camera, double aspect) {
  turn(eye, camera, aspect);
  eye.position = to_coin(camera.position());
  eye.heightAngle = static_cast<float>(OrbitCamera::kFieldOfView);
  const double distance = camera.placement().distance;
  eye.nearDistance = static_cast<float>(std::max(0.01, 0.05 * distance));
  eye.farDistance = static_cast<float>(distance + kReach);
  eye.focalDistance = static_cast<float>(distance);
}

void aim_camera(SoOrthographicCamera& eye, const OrbitCamera& camera, double aspect) {
  turn(eye, camera, aspect);
  const Eigen::Vector3d backwards = camera.orientation().col(2);
  eye.position = to_coin(Eigen::Vector3d(camera.placement().target + kReach * backwards));
  eye.height = static_cast<float>(camera.seen_height(camera.placement().distance));
  eye.nearDistance = 0.01F;
  eye.farDistance = static_cast<float>(2.0 * kReach);
  eye.focalDistance = static_cast<float>(kReach);
}

}  // namespace handway::gui
