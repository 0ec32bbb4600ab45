#include "model/meshes/coarse_mesh.h"

#include "handway/geometric/mesh/shape.h"
#include "model/meshes/crease_normals.h"
#include "model/meshes/drawn_mesh.h"
#include "model/meshes/solid_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace handway::gui {
namespace {

using geometric::TriangleMesh;

/// A square of 1 m with `count` squares of two triangles along each side, z by `height`.
template <typename Height>
TriangleMesh sheet(std::uint32_t count, const Height& height) {
  TriangleMesh mesh;
  for (std::uint32_t row = 0; row <= count; ++row) {
    for (std::uint32_t column = 0; column <= count; ++column) {
      const double x = static_cast<double>(column) / count, y = static_cast<double>(row) / count;
      mesh.vertices.emplace_back(x, y, height(x, y));
    }
  }
  for (std::uint32_t row = 0; row < count; ++row) {
    for (std::uint32_t column = 0; column < count; ++column) {
      const std::uint32_t a = row * (count + 1) + column, b = a + 1, c = a + count + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  }
  return mesh;
}

TriangleMesh coarse(const TriangleMesh& mesh, double error) { return coarsened(mesh, error).mesh; }

TEST(CoarseMeshes, NeedFewTrianglesForAFlatSheetAndKeepItsBorder) {
  const TriangleMesh made = coarse(sheet(20, [](double, double) { return 0.3; }), 1e-3);
  EXPECT_LT(made.triangles.size(), 60U) << "of 800";
  const geometric::Aabb box = geometric::bounding_box(made);
  EXPECT_LT((box.lower - Eigen::Vector3d(0.0, 0.0, 0.3)).norm(), 1e-3);
  EXPECT_LT((box.upper - Eigen::Vector3d(1.0, 1.0, 0.3)).norm(), 1e-3);
}

TEST(CoarseMeshes, KeepARidgeSharp) {
  const TriangleMesh made =
      coarse(sheet(20, [](double x, double) { return 0.5 - std::abs(x - 0.5); }), 1e-3);
  EXPECT_LT(made.triangles.size(), 80U) << "of 800";
  for (const Eigen::Vector3d& v : made.vertices) {
    EXPECT_NEAR(v.z(), 0.5 - std::abs(v.x() - 0.5), 3e-3);
  }
}

TEST(CoarseMeshes, StayNearARoundSurfaceAndLeaveItClosed) {
  const TriangleMesh ball = welded_to_draw(*geometric::tessellate(geometric::Sphere{0.5}));
  ASSERT_TRUE(is_solid(ball));
  std::size_t before = ball.triangles.size();
  for (const double error : {2e-3, 1e-2, 5e-2}) {
    const TriangleMesh made = coarse(ball, error);
    EXPECT_LT(made.triangles.size(), before);
    EXPECT_TRUE(is_solid(made)) << error;
    for (const Eigen::Vector3d& v : made.vertices) {
      EXPECT_NEAR(v.norm(), 0.5, 4.0 * error);
    }
    before = made.triangles.size();
  }
}

TEST(CoarseMeshes, StayOnTheSurfaceWithoutAnError) {
  const TriangleMesh ball = welded_to_draw(*geometric::tessellate(geometric::Sphere{0.5}));
  const TriangleMesh made = coarse(ball, 0.0);
  EXPECT_GT(made.triangles.size(), ball.triangles.size() / 2);
  for (const Eigen::Vector3d& v : made.vertices) {
    EXPECT_NEAR(v.norm(), 0.5, 0.01);
  }
}

TEST(SolidMeshes, AreClosedAndSeenFromOutside) {
  TriangleMesh box = welded_to_draw(*geometric::tessellate(geometric::Box{{1.0, 2.0, 3.0}}));
  EXPECT_TRUE(is_solid(box));
  TriangleMesh inside_out = box;
  for (auto& triangle : inside_out.triangles) {
    std::swap(triangle[0], triangle[1]);
  }
  EXPECT_FALSE(is_solid(inside_out));
  append(inside_out, transformed(box, geometric::Pose(Eigen::Translation3d(5.0, 0.0, 0.0))));
  EXPECT_FALSE(is_solid(inside_out)) << "one of its two pieces is not";
  box.triangles.pop_back();
  EXPECT_FALSE(is_solid(box));
  EXPECT_FALSE(is_solid({}));
}

TEST(DrawnMeshes, HaveCoarserOnesForSmallerPicturesIfThatPays) {
  const DrawnMesh ball = prepare_to_draw(*geometric::tessellate(geometric::Sphere{0.5}));
  EXPECT_TRUE(ball.is_solid);
  ASSERT_FALSE(ball.coarser.empty());
  std::size_t triangles = ball.fine.triangles.size();
  float area = 1e9F;
  for (const CoarserMesh& mesh : ball.coarser) {
    EXPECT_LT(mesh.mesh.triangles.size(), triangles);
    EXPECT_LT(mesh.most_area, area);
    triangles = mesh.mesh.triangles.size();
    area = mesh.most_area;
  }
  EXPECT_TRUE(prepare_to_draw(*geometric::tessellate(geometric::Box{{1, 1, 1}})).coarser.empty());
}

TEST(DrawnMeshes, AreShadedFromAfarAsFromNear) {
  const DrawnMesh ball = prepare_to_draw(*geometric::tessellate(geometric::Sphere{0.5}));
  ASSERT_FALSE(ball.coarser.empty());
  for (const CoarserMesh& coarser : ball.coarser) {
    const ShadedMesh& mesh = coarser.mesh;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      EXPECT_GT(mesh.normals[i].dot(mesh.vertices[i].normalized()), 0.9F);
    }
  }
}

TEST(DrawnMeshes, OfSheetsAreSeenFromBothSides) {
  EXPECT_FALSE(prepare_to_draw(sheet(4, [](double, double) { return 0.0; })).is_solid);
}

}  // namespace
}  // namespace handway::gui
