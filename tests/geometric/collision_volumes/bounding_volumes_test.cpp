#include "handway/geometric/collision/cache/bounding_volumes.h"

#include "handway/geometric/mesh/convex_hull.h"
#include "sample_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace handway::geometric {
namespace {

using Eigen::Vector3d;

// Returns the distance of a point from a convex surface, m; negative within.
double outside(const TriangleMesh& hull, const Vector3d& p) {
  double most = -std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : hull.triangles) {
    const Vector3d& corner = hull.vertices[a];
    const Vector3d normal =
        (hull.vertices[b] - corner).cross(hull.vertices[c] - corner).normalized();
    most = std::max(most, normal.dot(p - corner));
  }
  return most;
}

bool is_watertight(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& corners : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      ++edges[{corners[i], corners[(i + 1) % 3]}];
    }
  }
  return std::ranges::all_of(edges, [&](const auto& entry) {
    const auto& [from, to] = entry.first;
    const auto back = edges.find({to, from});
    return entry.second == 1 && back != edges.end() && back->second == 1;
  });
}

TEST(ConvexHull, OfABoxAndWhatIsWithinItIsTheBox) {
  std::vector<Vector3d> points{{0.0, 0.0, 0.0}, {0.1, -0.1, 0.2}};
  for (const double x : {-0.4, 0.4}) {
    for (const double y : {-0.2, 0.2}) {
      for (const double z : {-0.3, 0.3}) {
        points.emplace_back(x, y, z);
      }
    }
  }
  const TriangleMesh hull = convex_hull(points);
  EXPECT_EQ(hull.vertices.size(), 8U);
  EXPECT_EQ(hull.triangles.size(), 12U);
  EXPECT_TRUE(is_watertight(hull));
  EXPECT_NEAR(outside(hull, {0.0, 0.0, 0.31}), 0.01, 1e-12);
  EXPECT_NEAR(outside(hull, Vector3d::Zero()), -0.2, 1e-12);
}

TEST(ConvexHull, OfPointsInAPlaneIsEmpty) {
  const std::vector<Vector3d> square{
      {0.0, 0.0, 0.1}, {1.0, 0.0, 0.1}, {1.0, 1.0, 0.1}, {0.0, 1.0, 0.1}, {0.5, 0.5, 0.1}};
  EXPECT_TRUE(convex_hull(square).empty());
  EXPECT_TRUE(convex_hull(std::span(square).first(3)).empty());
  EXPECT_TRUE(convex_hull(std::vector<Vector3d>(9, Vector3d(0.2, 0.2, 0.2))).empty());
}

TEST(BoundingVolumes, ContainTheSurface) {
  for (const auto& [name, mesh] : test::sample_meshes()) {
    SCOPED_TRACE(name);
    const auto shared = std::make_shared<const TriangleMesh>(mesh);
    for (const double largest : {1.0, 0.05, 0.01}) {
      const BoundingVolumes volumes = bounding_volumes({shared}, largest).front();
      ASSERT_FALSE(volumes.hull.empty());
      EXPECT_TRUE(is_watertight(volumes.hull));
      for (const Vector3d& vertex : mesh.vertices) {
        EXPECT_LT(outside(volumes.hull, vertex), volumes.margin + 1e-6);
        EXPECT_TRUE(std::ranges::any_of(volumes.spheres, [&](const CoveringSphere& sphere) {
          return (vertex - sphere.centre).norm() <= sphere.radius + 1e-6;
        }));
      }
    }
  }
}

TEST(BoundingVolumes, AreMoreSpheresTheSmallerTheyMayBe) {
  const auto ball = tessellate(Sphere{0.1});
  const auto spheres = [&](double largest) { return bounding_volumes({ball}, largest)[0].spheres; };
  EXPECT_EQ(spheres(0.2).size(), 1U);
  EXPECT_GT(spheres(0.08).size(), 1U);
  EXPECT_GT(spheres(0.02).size(), spheres(0.08).size());
  for (const CoveringSphere& sphere : spheres(0.02)) {
    EXPECT_LE(sphere.radius, 0.02);
  }
}

}  // namespace
}  // namespace handway::geometric
