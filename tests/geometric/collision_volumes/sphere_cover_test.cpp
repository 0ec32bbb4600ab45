#include "collision/sphere_cover.h"

#include "sample_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace handway::geometric {
namespace {

constexpr double kLeaf = 0.01;  // m

// Is the point of `triangle` in a leaf's sphere that lists it, below spheres that
// contain it, too?
bool is_covered(const SphereCover& cover, std::uint32_t index, const Eigen::Vector3d& p,
                std::uint32_t triangle) {
  const SphereCover::Node& node = cover.nodes()[index];
  for (std::size_t k = 0; k < node.count; ++k) {
    const Eigen::Vector3d centre(node.x[k], node.y[k], node.z[k]);
    const Eigen::Vector3d normal(node.normal_x[k], node.normal_y[k], node.normal_z[k]);
    if ((p - centre).norm() > node.radius[k] * (1.0 + 1e-6) ||
        std::abs((p - centre).dot(normal)) > node.thickness[k] + 1e-7) {
      continue;
    }
    const std::uint32_t child = node.child[k];
    if ((child & SphereCover::kLeaf) == 0
            ? is_covered(cover, child, p, triangle)
            : std::ranges::count(cover.triangles(child & ~SphereCover::kLeaf), triangle) > 0) {
      return true;
    }
  }
  return false;
}

TEST(SphereCover, ContainsTheWholeSurfaceOnEveryLevel) {
  for (const auto& [name, mesh] : test::sample_meshes()) {
    SCOPED_TRACE(name);
    const SphereCover cover(mesh, kLeaf);
    test::RandomPoints points(mesh, 1.0);
    for (int i = 0; i < 2000; ++i) {
      std::uint32_t triangle = 0;
      const Eigen::Vector3d p = points.next_on(mesh, triangle);
      ASSERT_LE((p - cover.root().centre.cast<double>()).norm(), cover.root().radius + 1e-7);
      ASSERT_TRUE(is_covered(cover, 0, p, triangle)) << p.transpose();
    }
  }
}

TEST(SphereCover, CutsLargeTriangles) {
  const SphereCover cover(*tessellate(Box{{0.4, 0.3, 0.2}}), kLeaf);
  for (const SphereCover::Node& node : cover.nodes()) {
    for (std::size_t k = 0; k < node.count; ++k) {
      if ((node.child[k] & SphereCover::kLeaf) != 0) {
        EXPECT_LE(node.radius[k], 1.01 * kLeaf);
      }
    }
  }
}

TEST(SphereCover, IsFlatWhereTheSurfaceIs) {
  const SphereCover cover(test::sample_meshes()[2].mesh, kLeaf);  // the plate
  for (const SphereCover::Node& node : cover.nodes()) {
    for (std::size_t k = 0; k < node.count; ++k) {
      EXPECT_LT(node.thickness[k], 1e-6F);
    }
  }
}

}  // namespace
}  // namespace handway::geometric
