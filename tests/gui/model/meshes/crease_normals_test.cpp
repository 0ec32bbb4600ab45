#include "model/meshes/crease_normals.h"

#include "handway/geometric/math/units.h"
#include "handway/geometric/mesh/shape.h"

#include <gtest/gtest.h>

namespace handway::gui {
namespace {

TEST(CreaseNormals, KeepTheEdgesOfABoxSharp) {
  const auto box = geometric::tessellate(geometric::Box{Eigen::Vector3d(1.0, 2.0, 3.0)});
  const ShadedMesh shaded = with_crease_normals(*box, geometric::radians(35.0));
  EXPECT_EQ(shaded.triangles.size(), 12U);
  EXPECT_EQ(shaded.vertices.size(), 24U) << "three normals at each of eight corners";
  for (const Eigen::Vector3f& normal : shaded.normals) {
    EXPECT_FLOAT_EQ(normal.cwiseAbs().maxCoeff(), 1.0F);
  }
}

TEST(CreaseNormals, RoundASphere) {
  const auto ball = geometric::tessellate(geometric::Sphere{0.5});
  const ShadedMesh shaded = with_crease_normals(*ball, geometric::radians(35.0));
  for (std::size_t i = 0; i < shaded.vertices.size(); ++i) {
    EXPECT_GT(shaded.normals[i].dot(shaded.vertices[i].normalized()), 0.99F);
  }
}

}  // namespace
}  // namespace handway::gui
