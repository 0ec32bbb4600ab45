#include "collision/volumes/primitive_distance.h"

#include "collision/volumes/box_tree.h"
#include "collision/volumes/solid.h"
#include "sample_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace handway::geometric {
namespace {

constexpr double kSinglePrecision = 2e-6;  // of the size

struct SamplePrimitive {
  std::string name;
  Shape shape;
  double loss;  ///< m, more than the bound falls short by.
};

// Plain, flat, long, tiny and huge.
std::vector<SamplePrimitive> sample_primitives() {
  return {{"box", Box{{0.4, 0.1, 0.02}}, 1e-6},
          {"sheet", Box{{2.0, 1.0, 1e-7}}, 1e-6},
          {"hall", Box{{1000.0, 300.0, 20.0}}, 1e-3},
          {"crumb", Box{{1e-6, 2e-6, 1e-6}}, 1e-6},
          {"ball", Sphere{0.07}, 0.001},
          {"can", Cylinder{0.03, 0.12}, 0.0003},
          {"wire", Cylinder{0.0005, 5.0}, 1e-5},
          {"disk", Cylinder{3.0, 0.001}, 0.03},
          {"cone", Cone{0.1, 0.3}, 0.001},
          {"flat cone", Cone{1.0, 0.01}, 0.01}};
}

double size_of(const TriangleMesh& mesh) { return bounding_box(mesh).size().maxCoeff(); }

TEST(PrimitiveDistance, IsNeverAboveTheDistanceAndSeldomMuchBelow) {
  for (const auto& [name, shape, loss] : sample_primitives()) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = *tessellate(shape);
    const auto primitive = PrimitiveDistance::of(mesh);
    ASSERT_TRUE(primitive);
    const BoxTree boxes(mesh);
    test::RandomPoints points(mesh, 2.0);
    for (int i = 0; i < 4000; ++i) {
      const Eigen::Vector3d p = points.next().cast<float>().cast<double>();
      const double distance = nearest_point(mesh, boxes, p).distance;
      const double rounding = kSinglePrecision * (p.norm() + size_of(mesh));
      const auto bound = static_cast<double>(primitive->bound(p.cast<float>()));
      ASSERT_LE(bound, distance + rounding) << p.transpose();
      ASSERT_GE(bound, distance - loss - rounding) << p.transpose();
    }
  }
}

TEST(PrimitiveDistance, HasATangentBelowTheDistanceEverywhere) {
  for (const auto& [name, shape, loss] : sample_primitives()) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = *tessellate(shape);
    const auto primitive = PrimitiveDistance::of(mesh);
    ASSERT_TRUE(primitive);
    const BoxTree boxes(mesh);
    test::RandomPoints points(mesh, 2.0);
    for (int i = 0; i < 4000; ++i) {
      const Eigen::Vector3f p = points.next().cast<float>();
      const Eigen::Vector3d q = points.next();
      const auto [distance, slope] = primitive->tangent(p);
      if (distance > 0.0F) {
        const double bound =
            static_cast<double>(distance) + slope.cast<double>().dot(q - p.cast<double>());
        ASSERT_LE(bound, nearest_point(mesh, boxes, q).distance +
                             5.0 * kSinglePrecision * (q.norm() + size_of(mesh)))
            << p.transpose() << " for " << q.transpose();
      }
    }
  }
}

TEST(PrimitiveDistance, KnowsTheInsideOfMostPoints) {
  for (const auto& [name, shape, loss] : sample_primitives()) {
    SCOPED_TRACE(name);
    const TriangleMesh mesh = *tessellate(shape);
    const auto primitive = PrimitiveDistance::of(mesh);
    ASSERT_TRUE(primitive);
    const BoxTree boxes(mesh);
    // A part of its own makes it no primitive: this one counts rays.
    TriangleMesh with_speck = mesh;
    append(with_speck, transformed(*tessellate(Box{{1e-3, 1e-3, 1e-3}}),
                                   Pose(Eigen::Translation3d(1e4, 0, 0))));
    const Solid counted(with_speck);
    const Solid solid(mesh);
    test::RandomPoints points(mesh, 1.2);
    for (int i = 0; i < 4000; ++i) {
      const Eigen::Vector3d p = points.next();
      if (nearest_point(mesh, boxes, p).distance > 1e-9 * size_of(mesh)) {
        ASSERT_EQ(solid.contains(p), counted.contains(p)) << p.transpose();
      }
    }
  }
}

TEST(PrimitiveDistance, TakesAnyBoxAlongTheAxesForOne) {
  const TriangleMesh box = *tessellate(Box{{0.4, 0.1, 0.02}});
  EXPECT_TRUE(PrimitiveDistance::of(transformed(box, Pose(Eigen::Translation3d(1, 2, 3)))));
  TriangleMesh reversed = box;
  std::ranges::reverse(reversed.triangles);
  EXPECT_TRUE(PrimitiveDistance::of(reversed));
}

TEST(PrimitiveDistance, TakesNothingElseForAPrimitive) {
  const TriangleMesh box = *tessellate(Box{{0.4, 0.1, 0.02}});
  TriangleMesh open = box;
  open.triangles.pop_back();
  EXPECT_FALSE(PrimitiveDistance::of(open));
  TriangleMesh twice = box;
  twice.triangles.back() = twice.triangles.front();
  EXPECT_FALSE(PrimitiveDistance::of(twice));
  TriangleMesh diagonal = box;  // a sheet through it in the place of a face
  diagonal.triangles[10] = {0, 3, 7};
  diagonal.triangles[11] = {0, 7, 4};
  EXPECT_FALSE(PrimitiveDistance::of(diagonal));
  EXPECT_FALSE(PrimitiveDistance::of(
      transformed(box, pose_from_rpy(Eigen::Vector3d::Zero(), 0.1, 0.0, 0.0))));
  EXPECT_FALSE(PrimitiveDistance::of(
      transformed(*tessellate(Cylinder{0.1, 0.2}), Pose(Eigen::Translation3d(0.1, 0, 0)))));
  EXPECT_FALSE(PrimitiveDistance::of(
      transformed(*tessellate(Sphere{0.1}), Pose::Identity(), {1.0, 1.1, 1.0})));
  TriangleMesh dented = *tessellate(Sphere{0.1});
  dented.vertices[100] *= 0.9;
  EXPECT_FALSE(PrimitiveDistance::of(dented));
}

}  // namespace
}  // namespace handway::geometric
