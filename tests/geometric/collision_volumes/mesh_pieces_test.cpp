#include "handway/geometric/mesh/triangle_mesh.h"
#include "sample_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>

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
  const std::vector<std::uint32_t> pieces = piece_numbers(mesh);
  ASSERT_EQ(pieces.size(), 16U);
  EXPECT_EQ(std::ranges::count(pieces, 0U), 8);
  EXPECT_EQ(std::ranges::count(pieces, 1U), 8);
}

TEST(MeshPieces, AreFoundWhereNoVertexIsShared) {
  const TriangleMesh mesh = unshared(*tessellate(Box{{0.1, 0.2, 0.3}}));
  ASSERT_EQ(mesh.vertices.size(), 36U);
  const TriangleMesh whole = distinct_triangles(welded(mesh));
  EXPECT_EQ(piece_numbers(whole), std::vector<std::uint32_t>(8, 0));
  EXPECT_TRUE(is_closed(whole));
}

TEST(MeshPieces, AreClosedOrNot) {
  for (const auto& [name, mesh] : test::sample_meshes()) {
    const bool solid = name == "box" || name == "can" || name == "two balls";
    EXPECT_EQ(is_closed(distinct_triangles(welded(mesh))), solid) << name;
  }
  TriangleMesh holed = *tessellate(Box{{0.1, 0.2, 0.3}});
  holed.triangles.pop_back();
  EXPECT_FALSE(is_closed(distinct_triangles(welded(holed))));
}

}  // namespace
}  // namespace handway::geometric
