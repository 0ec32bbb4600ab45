#include "collision/volumes/distance_field.h"

#include "collision/volumes/box_tree.h"
#include "sample_meshes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <thread>
#include <vector>

namespace handway::geometric {
namespace {

constexpr std::size_t kCells = 4096;
constexpr double kSinglePrecision = 2e-6;  // m, within a metre

DistanceField growing(const std::shared_ptr<const TriangleMesh>& mesh) {
  return DistanceField::growing(mesh,
                                OnDemand<TriangleTree>([mesh] { return TriangleTree(*mesh); }));
}

TEST(DistanceField, IsNeverAboveTheDistance) {
  for (const auto& [name, mesh] : test::sample_meshes()) {
    SCOPED_TRACE(name);
    const BoxTree boxes(mesh);
    const DistanceField field(mesh, TriangleTree(mesh), kCells);
    test::RandomPoints points(mesh, 3.0);
    for (int i = 0; i < 5000; ++i) {
      const Eigen::Vector3d p = points.next();
      ASSERT_LE(field.bound(p.cast<float>()),
                nearest_point(mesh, boxes, p).distance + kSinglePrecision)
          << p.transpose();
    }
  }
}

TEST(DistanceField, IsNeverAboveTheDistanceWhereItGrows) {
  for (const auto& [name, mesh] : test::sample_meshes()) {
    SCOPED_TRACE(name);
    const BoxTree boxes(mesh);
    const DistanceField field = growing(std::make_shared<const TriangleMesh>(mesh));
    test::RandomPoints points(mesh, 3.0);
    for (int i = 0; i < 5000; ++i) {
      const Eigen::Vector3d p = points.next();
      ASSERT_LE(field.bound(p.cast<float>()),
                nearest_point(mesh, boxes, p).distance + kSinglePrecision)
          << p.transpose();
    }
  }
}

TEST(DistanceField, GrowsTheSameWhoeverComesFirst) {
  const auto mesh = tessellate(Cylinder{0.03, 0.12});
  std::vector<Eigen::Vector3f> points;
  test::RandomPoints random(*mesh, 2.0);
  for (int i = 0; i < 3000; ++i) {
    points.emplace_back(random.next().cast<float>());
  }
  const auto bounds = [&points](const DistanceField& field) {
    std::vector<float> found;
    for (const Eigen::Vector3f& p : points) {
      found.push_back(field.bound(p));
    }
    return found;
  };
  const std::vector<float> expected = bounds(growing(mesh));
  const DistanceField shared = growing(mesh);
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&, i] {
        for (std::size_t k = 0; k < points.size(); ++k) {
          static_cast<void>(shared.bound(points[i % 2 == 0 ? k : points.size() - 1 - k]));
        }
      });
    }
  }
  EXPECT_EQ(bounds(shared), expected);
}

TEST(DistanceField, BoundsTrianglesWhereItGrows) {
  const auto mesh = tessellate(Cylinder{0.03, 0.12});
  const BoxTree boxes(*mesh);
  const DistanceField field = growing(mesh);
  test::RandomPoints points(*mesh, 1.5);
  int bounded = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d a = points.next();
    const Eigen::Vector3d b = a + 0.001 * Eigen::Vector3d(1, 0, 0.5);
    const Eigen::Vector3d c = a + 0.001 * Eigen::Vector3d(0, 1, -0.5);
    const float bound = field.bound(
        std::array<Eigen::Vector3f, 3>{a.cast<float>(), b.cast<float>(), c.cast<float>()});
    for (const Eigen::Vector3d& p : {a, b, c, Eigen::Vector3d((a + b + c) / 3.0)}) {
      ASSERT_LE(bound, nearest_point(*mesh, boxes, p).distance + kSinglePrecision);
    }
    bounded += bound > 0.0F ? 1 : 0;
  }
  EXPECT_GT(bounded, 200);
}

TEST(DistanceField, IsTheDistanceAlongAFlatFaceOnEitherSide) {
  const TriangleMesh mesh = test::sample_meshes()[2].mesh;  // the plate
  const DistanceField field(mesh, TriangleTree(mesh), kCells);
  for (const double height : {0.001, 0.01, 0.1, -0.001, -0.01, -0.1}) {
    EXPECT_NEAR(field.bound(Eigen::Vector3d(0.5, 0.25, height).cast<float>()), std::abs(height),
                1e-4);
  }
}

TEST(DistanceField, LosesLittleNearACurvedSurface) {
  const TriangleMesh mesh = *tessellate(Cylinder{0.03, 0.12});
  const BoxTree boxes(mesh);
  const DistanceField field(mesh, TriangleTree(mesh), 1U << 14);
  for (int i = 0; i < 360; ++i) {
    const double angle = i * 3.14159265358979 / 180.0;
    const Eigen::Vector3d p(0.035 * std::cos(angle), 0.035 * std::sin(angle), 0.01);
    EXPECT_GT(field.bound(p.cast<float>()), nearest_point(mesh, boxes, p).distance - 0.001);
  }
}

TEST(DistanceField, FarAwayIsTheDistanceFromTheBox) {
  const TriangleMesh mesh = *tessellate(Box{{0.4, 0.1, 0.02}});
  const DistanceField field(mesh, TriangleTree(mesh), kCells);
  EXPECT_NEAR(field.bound({10.2F, 0.0F, 0.0F}), 10.0F, 1e-5F);
}

TEST(DistanceField, BoundsTrianglesThatAreInOneCell) {
  const TriangleMesh mesh = *tessellate(Cylinder{0.03, 0.12});
  const BoxTree boxes(mesh);
  const DistanceField field(mesh, TriangleTree(mesh), kCells);
  test::RandomPoints points(mesh, 1.5);
  int bounded = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d a = points.next();
    const Eigen::Vector3d b = a + 0.001 * Eigen::Vector3d(1, 0, 0.5);
    const Eigen::Vector3d c = a + 0.001 * Eigen::Vector3d(0, 1, -0.5);
    const float bound = field.bound(
        std::array<Eigen::Vector3f, 3>{a.cast<float>(), b.cast<float>(), c.cast<float>()});
    for (const Eigen::Vector3d& p : {a, b, c, Eigen::Vector3d((a + b + c) / 3.0)}) {
      ASSERT_LE(bound, nearest_point(mesh, boxes, p).distance + kSinglePrecision);
    }
    bounded += bound > 0.0F ? 1 : 0;
  }
  EXPECT_GT(bounded, 200);
}

}  // namespace
}  // namespace handway::geometric
