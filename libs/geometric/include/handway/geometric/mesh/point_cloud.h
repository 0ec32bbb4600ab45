#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/mesh/triangle_mesh.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace handway::geometric {

/// Points on the surfaces that a depth camera or a scanner has seen.
struct PointCloud {
  std::vector<Eigen::Vector3f> points;              ///< m, in the frame of the body; finite.
  std::vector<std::array<std::uint8_t, 3>> colors;  ///< RGB of each point; or empty.
  /// Edge (m) of the cells whose centres the points are, as in an octomap; 0 for measured points.
  double cell = 0.0;

  [[nodiscard]] std::size_t size() const { return points.size(); }
};

/// The way in which points become a body: the body consists of all cells of a regular grid that a
/// ball of `radius` around a point touches. All that is nearer than `radius` to a point is in the
/// body.
struct CloudCells {
  double size = 0.01;   ///< Edge of a cell, m: from kSmallestCell to kLargestCell.
  double radius = 0.0;  ///< m, for example the error of the camera; at most most_radius().

  friend bool operator==(const CloudCells&, const CloudCells&) = default;
};

inline constexpr double kSmallestCell = 0.001;  ///< m
inline constexpr double kLargestCell = 1.0;     ///< m

/// Returns the largest radius for cells of a size (m): a ball then touches 1,331 cells at most.
[[nodiscard]] constexpr double most_radius(double cell_size) { return 5.0 * cell_size; }

/// Largest coordinate of a point, m: single precision rounds it by 10 µm at most.
inline constexpr float kLargestCloudCoordinate = 160.0F;
/// The largest number of points of a cloud.
inline constexpr std::size_t kMostCloudPoints = 20'000'000;

/// Returns the surface of the cells around the points, in the frame of the points. The surface is
/// closed: every edge belongs to two triangles or four. Cells lie between multiples of their size.
/// @returns nothing if the surface has more than four million triangles.
/// @pre coordinates are at most kLargestCloudCoordinate.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<TriangleMesh> cells_around(
    const PointCloud& cloud, const CloudCells& cells);

/// Returns the points for which `keep` holds, with their colours.
template <typename Keep>
[[nodiscard]] PointCloud points_where(const PointCloud& cloud, const Keep& keep) {
  PointCloud kept;
  kept.cell = cloud.cell;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (keep(i)) {
      kept.points.push_back(cloud.points[i]);
      if (!cloud.colors.empty()) {
        kept.colors.push_back(cloud.colors[i]);
      }
    }
  }
  return kept;
}

}  // namespace handway::geometric
