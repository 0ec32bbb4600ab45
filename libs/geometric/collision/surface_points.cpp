#include "collision/surface_points.h"

#include "collision/nearest_point.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace handway::geometric {
namespace {

// A piece's vertices and the middles of its triangles.
std::vector<Eigen::Vector3d> candidates(const TriangleMesh& piece) {
  std::vector<Eigen::Vector3d> points = piece.vertices;
  for (std::uint32_t t = 0; t < piece.triangles.size(); ++t) {
    const auto [a, b, c] = corners(piece, t);
    points.emplace_back((a + b + c) / 3.0);
  }
  return points;
}

}  // namespace

// Each point is the farthest from those before it.
SurfacePoints::SurfacePoints(const TriangleMesh& piece) {
  const std::vector<Eigen::Vector3d> points = candidates(piece);
  std::vector<double> distances(points.size(), std::numeric_limits<double>::max());
  std::size_t next = 0;
  for (std::size_t k = 0; k < kCount; ++k) {
    const Eigen::Vector3d& p = points[next];
    x[k] = static_cast<float>(p.x());
    y[k] = static_cast<float>(p.y());
    z[k] = static_cast<float>(p.z());
    for (std::size_t i = 0; i < points.size(); ++i) {
      distances[i] = std::min(distances[i], (points[i] - p).squaredNorm());
    }
    next = static_cast<std::size_t>(std::ranges::max_element(distances) - distances.begin());
  }
}

}  // namespace handway::geometric
