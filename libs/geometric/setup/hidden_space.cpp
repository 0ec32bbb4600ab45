#include "handway/geometric/setup/hidden_space.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

namespace handway::geometric {
namespace {

using Pixel = Eigen::Vector2i;

/// The least depth of the points at each pixel of a camera.
class DepthMap {
 public:
  DepthMap(const PointCloud& seen, const DepthCamera& camera) : camera_(camera) {
    Pixel last = Pixel::Constant(-1);
    for (const Eigen::Vector3f& point : seen.points) {
      last = last.cwiseMax(pixel_of(point));
    }
    size_ = (last.array() + 1).min(kLargestImage).max(0);
    depths_.assign(static_cast<std::size_t>(size_.x()) * static_cast<std::size_t>(size_.y()),
                   kNotMeasured);
    for (const Eigen::Vector3f& point : seen.points) {
      const Pixel pixel = pixel_of(point);
      if (is_inside(pixel)) {
        float& depth = depths_[index_of(pixel)];
        depth = std::min(depth, point.z());
      }
    }
  }

  /// Returns the depth in the direction of a point of the optical frame; infinity if it was not
  /// measured.
  [[nodiscard]] float depth_towards(const Eigen::Vector3f& point) const {
    const Pixel pixel = pixel_of(point);
    return is_inside(pixel) ? depths_[index_of(pixel)] : kNotMeasured;
  }

 private:
  static constexpr float kNotMeasured = std::numeric_limits<float>::infinity();
  static constexpr int kLargestImage = 16384;  // pixels

  // (-1, -1) for what is behind the camera, or far beside the image.
  [[nodiscard]] Pixel pixel_of(const Eigen::Vector3f& point) const {
    if (!(point.z() > 0.0F)) {
      return Pixel::Constant(-1);
    }
    const Eigen::Vector2d place =
        camera_.focal.cwiseProduct(point.head<2>().cast<double>()) / point.z() + camera_.centre;
    const bool is_near = (place.array() > -0.5).all() && (place.array() < kLargestImage).all();
    return is_near ? Pixel(place.array().round().cast<int>()) : Pixel(Pixel::Constant(-1));
  }
  [[nodiscard]] bool is_inside(const Pixel& pixel) const {
    return (pixel.array() >= 0).all() && (pixel.array() < size_.array()).all();
  }
  [[nodiscard]] std::size_t index_of(const Pixel& pixel) const {
    return static_cast<std::size_t>(pixel.y()) * static_cast<std::size_t>(size_.x()) +
           static_cast<std::size_t>(pixel.x());
  }

  const DepthCamera& camera_;
  Pixel size_;
  std::vector<float> depths_;
};

// Numbers of cells along the axes of a box.
Eigen::Vector3i cells_of(const Aabb& box, double cell) {
  const Eigen::Array3d counts = (box.size().array() / cell).ceil().max(1.0);
  if (counts.prod() > static_cast<double>(kMostCloudPoints)) {
    throw InputError({"hidden space", "", fmt::format("{:.3g} cells", counts.prod()),
                      fmt::format("at most {}", kMostCloudPoints),
                      "Make the cells larger, or the box smaller"});
  }
  return counts.cast<int>();
}

}  // namespace

PointCloud hidden_cells(const PointCloud& seen, const DepthCamera& camera, const Pose& X_WC,
                        const Aabb& box, double cell) {
  const DepthMap depths(seen, camera);
  const Eigen::Vector3i counts = cells_of(box, cell);
  const Pose X_CW = X_WC.inverse();
  const auto margin = static_cast<float>(std::numbers::sqrt3 * cell);
  PointCloud hidden;
  hidden.cell = cell;
  for (int z = 0; z < counts.z(); ++z) {
    for (int y = 0; y < counts.y(); ++y) {
      for (int x = 0; x < counts.x(); ++x) {
        const Eigen::Vector3d centre = cell * (Eigen::Vector3d(x, y, z).array() + 0.5);
        const Eigen::Vector3f p_C = (X_CW * (box.lower + centre)).cast<float>();
        if (p_C.z() > depths.depth_towards(p_C) + margin) {
          hidden.points.push_back(centre.cast<float>());
        }
      }
    }
  }
  return hidden;
}

}  // namespace handway::geometric
