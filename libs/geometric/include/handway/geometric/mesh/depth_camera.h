#pragma once

#include <Eigen/Core>

namespace handway::geometric {

/// A pinhole camera without distortion, as ROS's CameraInfo (K) describes it.
struct DepthCamera {
  Eigen::Vector2d focal{0.0, 0.0};   ///< fx and fy, pixels.
  Eigen::Vector2d centre{0.0, 0.0};  ///< cx and cy, pixels.
  double unit = 0.001;               ///< m for 1 in the image.
  double farthest = 10.0;            ///< m; what is farther away counts as not measured.
};

}  // namespace handway::geometric
