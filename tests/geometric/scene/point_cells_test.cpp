/// The body around points: every point within the radius is inside, and the surface is closed.
#include <handway/geometric/mesh/point_cloud.h>
#include <handway/geometric/mesh/shape.h>
#include <handway/geometric/mesh/triangle_mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

namespace handway::geometric {
namespace {

PointCloud random_points(int count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(-0.1F, 0.1F);
  PointCloud cloud;
  for (int i = 0; i < count; ++i) {
    cloud.points.emplace_back(place(random), place(random), place(random));
  }
  return cloud;
}

// Crossings of a ray upwards from p with the surface: odd inside. Surfaces of cells are made of
// axis-parallel triangles, so that a ray that is not on an edge decides.
bool is_inside(const TriangleMesh& mesh, const Eigen::Vector3d& p) {
  int crossings = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Eigen::Vector3d &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
    if (a.z() != b.z() || b.z() != c.z() || a.z() < p.z()) {
      continue;
    }
    const auto side = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
      return (to.x() - from.x()) * (p.y() - from.y()) - (to.y() - from.y()) * (p.x() - from.x());
    };
    const double s = side(a, b), t = side(b, c), u = side(c, a);
    crossings += (s >= 0 && t >= 0 && u >= 0) || (s <= 0 && t <= 0 && u <= 0) ? 1 : 0;
  }
  return crossings % 2 == 1;
}

double volume_of(const TriangleMesh& mesh) {
  double volume = 0.0;
  for (const auto& [i, j, k] : mesh.triangles) {
    volume += mesh.vertices[i].dot(mesh.vertices[j].cross(mesh.vertices[k])) / 6.0;
  }
  return volume;
}

TEST(CellsAroundPoints, OfOnePointAreOneCube) {
  const PointCloud cloud{{{0.004F, -0.003F, 0.012F}}, {}, 0.0};
  const TriangleMesh mesh = cells_around(cloud, {0.01, 0.0}).value();
  EXPECT_EQ(mesh.triangles.size(), 12U);
  const Aabb box = bounding_box(mesh);
  EXPECT_TRUE(box.lower.isApprox(Eigen::Vector3d(0.0, -0.01, 0.01), 1e-12));
  EXPECT_TRUE(box.size().isApprox(Eigen::Vector3d::Constant(0.01), 1e-12));
  EXPECT_NEAR(volume_of(mesh), 1e-6, 1e-15);
}

// Two cells that share only an edge, or only a corner, are closed pieces all the same.
TEST(CellsAroundPoints, ThatTouchAtEdgesAreClosed) {
  for (const Eigen::Vector3f& other :
       {Eigen::Vector3f(0.015F, 0.015F, 0.005F), Eigen::Vector3f(0.015F, 0.015F, 0.015F)}) {
    const PointCloud cloud{{{0.005F, 0.005F, 0.005F}, other}, {}, 0.0};
    const TriangleMesh mesh = cells_around(cloud, {0.01, 0.0}).value();
    EXPECT_EQ(mesh.triangles.size(), 24U);
    EXPECT_TRUE(is_closed(mesh));
    EXPECT_NEAR(volume_of(mesh), 2e-6, 1e-15);
  }
}

TEST(CellsAroundPoints, ContainAllWithinTheRadiusAndNothingFartherThanACell) {
  const PointCloud cloud = random_points(40);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-0.15, 0.15);
  for (const double radius : {0.0, 0.004, 0.03}) {
    const CloudCells cells{0.0101, radius};
    const TriangleMesh mesh = cells_around(cloud, cells).value();
    EXPECT_TRUE(is_closed(mesh));
    int inside = 0;
    for (int i = 0; i < 3000; ++i) {
      const Eigen::Vector3d p(place(random), place(random), place(random));
      double distance = 1.0;
      for (const Eigen::Vector3f& point : cloud.points) {
        distance = std::min(distance, (p - point.cast<double>()).norm());
      }
      if (distance < radius) {
        EXPECT_TRUE(is_inside(mesh, p)) << distance;
        ++inside;
      } else if (distance > radius + std::sqrt(3.0) * cells.size) {
        EXPECT_FALSE(is_inside(mesh, p)) << distance;
      }
    }
    EXPECT_EQ(inside > 0, radius > 0.0);
    for (const Eigen::Vector3f& point : cloud.points) {
      EXPECT_TRUE(is_inside(mesh, point.cast<double>()));
    }
  }
}

TEST(CellsAroundPoints, AreNotMadeWithoutLimit) {
  PointCloud cloud;
  for (int i = 0; i < 400'000; ++i) {  // a grid of single cells
    const Eigen::Vector3i cell(i % 80, i / 80 % 80, i / 6400);
    cloud.points.emplace_back((0.02 * cell.cast<double>().array() + 0.005).cast<float>());
  }
  EXPECT_FALSE(cells_around(cloud, {0.01, 0.0}));
  EXPECT_TRUE(cells_around(cloud, {0.05, 0.0}));
}

}  // namespace
}  // namespace handway::geometric
