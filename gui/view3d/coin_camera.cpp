#include "view3d/coin_camera.h"

#include "view3d/coin_conversions.h"
#include "view3d/orbit_camera.h"

#include <Inventor/nodes/SoPerspectiveCamera.h>

#include <algorithm>

namespace handway::gui {

void aim_camera(SoPerspectiveCamera& eye, const OrbitCamera& camera, double aspect) {
  const Eigen::Matrix3f R = camera.orientation().cast<float>();
  SbMatrix turn = SbMatrix::identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      turn[row][column] = R(column, row);
    }
  }
  eye.viewportMapping = SoCamera::LEAVE_ALONE;
  eye.aspectRatio = static_cast<float>(aspect);
  eye.position = to_coin(camera.position());
  eye.orientation = SbRotation(turn);
  eye.heightAngle = static_cast<float>(OrbitCamera::kFieldOfView);
  const double distance = camera.placement().distance;
  eye.nearDistance = static_cast<float>(std::max(0.01, 0.05 * distance));
  eye.farDistance = static_cast<float>(distance + 12.0);
  eye.focalDistance = static_cast<float>(distance);
}

}  // namespace handway::gui
