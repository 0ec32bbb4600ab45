#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/mesh/depth_camera.h"
#include "handway/geometric/mesh/point_cloud.h"

#include <Eigen/Core>

#include <filesystem>

namespace handway::geometric {

/// Reads a depth image, a grey PNG of 8 or 16 bits or a NumPy array of shape h×w: its points in the
/// camera's optical frame, x to the right, y down, z forwards (REP 103). Pixels of 0 and those that
/// are not finite have not been measured.
/// @throws InputError if it is missing, damaged, no such image, or has no measured pixel; if the
/// camera has no focal length.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT PointCloud
read_depth_image(const std::filesystem::path& file, const DepthCamera& camera);

/// Rotation of a camera's optical frame (x to the right, y down, z forwards) in the frame of its
/// body (x forwards, y to the left, z up), as REP 103 names both.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT Eigen::Matrix3d optical_frame();

/// Returns whether the file's name is that of an image: .png.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool is_image_file(const std::filesystem::path& file);

}  // namespace handway::geometric
