#include "collision/volumes/triangle_tree.h"
#include "sample_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace handway::geometric {
namespace {

TEST(TriangleBlock, TellsTheDistanceFromTheNearestTriangle) {
  for (const auto& [name, mesh] : test::sample_meshes()) {
    SCOPED_TRACE(name);
    std::vector<TriangleCorners> triangles;
    for (std::uint32_t t = 0;
         t < std::min<std::size_t>(TriangleBlock::kWidth, mesh.triangles.size()); ++t) {
      triangles.push_back(corners(mesh, t));
    }
    const TriangleBlock block(triangles);
    test::RandomPoints points(mesh, 2.0);
    for (int i = 0; i < 2000; ++i) {
      const Eigen::Vector3d p = points.next();
      double least = 1e9;
      for (const TriangleCorners& triangle : triangles) {
        least = std::min(least, (p - nearest_on_triangle(triangle, p)).norm());
      }
      ASSERT_NEAR(block.distance(p.cast<float>()), least, 2e-6) << p.transpose();
    }
  }
}

}  // namespace
}  // namespace handway::geometric
