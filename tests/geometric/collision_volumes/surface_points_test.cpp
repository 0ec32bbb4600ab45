#include "collision/volumes/box_cover.h"
#include "collision/volumes/box_tree.h"
#include "sample_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace handway::geometric {
namespace {

Eigen::Vector3d point(const SurfacePoints& points, std::size_t k) {
  return {points.x[k], points.y[k], points.z[k]};
}

TEST(SurfacePoints, LieOnTheSurface) {
  for (const auto& [name, mesh] : test::sample_meshes()) {
    SCOPED_TRACE(name);
    const BoxTree boxes(mesh);
    const SurfacePoints points(mesh);
    for (std::size_t k = 0; k < SurfacePoints::kCount; ++k) {
      EXPECT_LT(nearest_point(mesh, boxes, point(points, k)).distance, 1e-6);
    }
  }
}

TEST(SurfacePoints, LeaveNoLargePartOut) {
  const double radius = 0.03;
  const SurfacePoints points(*tessellate(Sphere{radius}));
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d p =
        radius * Eigen::Vector3d(std::cos(i), std::sin(i), 0.02 * i - 1.0).normalized();
    double nearest = 1.0;
    for (std::size_t k = 0; k < SurfacePoints::kCount; ++k) {
      nearest = std::min(nearest, (point(points, k) - p).norm());
    }
    EXPECT_LT(nearest, 0.4 * radius);
  }
}

}  // namespace
}  // namespace handway::geometric
