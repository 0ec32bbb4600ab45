#include "handway/geometric/mesh/triangle_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace handway::geometric {
namespace {

using ::testing::ElementsAre;

// Two triangles with a common side, each with corners of its own.
TriangleMesh quad_of_unshared_corners() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
          {{0, 1, 2}, {3, 4, 5}}};
}

TEST(MeshTopology, WeldsCornersAtTheSamePlace) {
  const TriangleMesh quad = welded(quad_of_unshared_corners());
  EXPECT_EQ(quad.vertices.size(), 4U);
  EXPECT_THAT(quad.triangles, ElementsAre(ElementsAre(0U, 1U, 2U), ElementsAre(1U, 3U, 2U)));
}

TEST(MeshTopology, WeldsWhatAGridTakesForOnePlace) {
  TriangleMesh mesh = quad_of_unshared_corners();
  mesh.vertices[3].x() += 1e-9;
  mesh.vertices[5].z() -= 1e-9;
  EXPECT_EQ(welded(mesh).vertices.size(), 6U);
  EXPECT_EQ(welded(mesh, 1e-7).vertices.size(), 4U);
}

TEST(MeshTopology, TakesBothZerosForOne) {
  TriangleMesh mesh = quad_of_unshared_corners();
  mesh.vertices[3].z() = -0.0;
  EXPECT_EQ(welded(mesh).vertices.size(), 4U);
}

TEST(MeshTopology, NumbersThePiecesOfVertices) {
  const TriangleMesh mesh = quad_of_unshared_corners();
  EXPECT_THAT(piece_numbers(mesh), ElementsAre(0U, 0U, 0U, 1U, 1U, 1U));
  EXPECT_THAT(piece_numbers(welded(mesh)), ElementsAre(0U, 0U, 0U, 0U));
  EXPECT_THAT(piece_numbers({{{0, 0, 0}, {1, 0, 0}}, {}}), ElementsAre(0U, 1U));
}

}  // namespace
}  // namespace handway::geometric
