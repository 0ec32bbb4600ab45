#include "handway/geometric/mesh/triangle_mesh.h"
#include "sample_meshes.h"

#include <gtest/gtest.h>

namespace handway::geometric {
namespace {

// Each triangle with vertices of its own, as STL files have them.
TriangleMesh unshared(const TriangleMesh& mesh) {
  TriangleMesh result;
  for (const auto& triangle : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(result.vertices.size());
    for (const std::uint32_t vertex : triangle) {
      result.vertices.push_back(mesh.vertices[vertex]);
    }
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

TEST(MeshPieces, HangTogether) {
  TriangleMesh mesh = *tessellate(Box{{0.1, 0.1, 0.1}});
  append(mesh, transformed(*tessellate(Box{{0.4, 0.4, 0.4}}), Pose(Eigen::Translation3d(1, 0, 0))));
  const std::vector<TriangleMesh> pieces = pieces_of(mesh);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_NEAR(bounding_box(pieces[0]).size().x(), 0.4, 1e-12) << "the largest comes first";
  EXPECT_EQ(pieces[0].triangles.size(), 12U);
  EXPECT_EQ(pieces[0].vertices.size(), 8U);
  EXPECT_NEAR(bounding_box(pieces[1]).size().x(), 0.1, 1e-12);
}

TEST(MeshPieces, AreFoundWhereNoVertexIsShared) {
  const TriangleMesh mesh = unshared(*tessellate(Box{{0.1, 0.2, 0.3}}));
  ASSERT_EQ(mesh.vertices.size(), 36U);
  const std::vector<TriangleMesh> pieces = pieces_of(mesh);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].vertices.size(), 8U);
  EXPECT_TRUE(is_closed(pieces[0]));
}

TEST(MeshPieces, AreClosedOrNot) {
  for (const auto& [name, mesh] : test::sample_meshes()) {
    const bool solid = name == "box" || name == "can" || name == "two balls";
    EXPECT_EQ(is_closed(pieces_of(mesh).front()), solid) << name;
  }
  TriangleMesh holed = *tessellate(Box{{0.1, 0.2, 0.3}});
  holed.triangles.pop_back();
  EXPECT_FALSE(is_closed(pieces_of(holed).front()));
}

}  // namespace
}  // namespace handway::geometric
