#include "convex_parts.h"
#include "handway/geometric/mesh/shape.h"

#include <gtest/gtest.h>

namespace handway::simulate_mujoco {
namespace {

void expect_equal(const std::vector<ConvexPart>& parts, const std::vector<ConvexPart>& expected) {
  ASSERT_EQ(parts.size(), expected.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    EXPECT_EQ(parts[i].volume, expected[i].volume);
    EXPECT_EQ(parts[i].corners, expected[i].corners);
  }
}

TEST(ConvexPartsCache, GivesTheSamePartsAgain) {
  const geometric::TriangleMesh cone = *geometric::tessellate(geometric::Cone{0.03, 0.1});
  const std::vector<ConvexPart> expected = convex_parts(cone);
  ASSERT_FALSE(expected.empty());
  expect_equal(cached_convex_parts(cone), expected);
  expect_equal(cached_convex_parts(cone), expected);
}

TEST(ConvexPartsCache, TellsLimitsAndMeshesApart) {
  const geometric::TriangleMesh ball = *geometric::tessellate(geometric::Sphere{0.03});
  geometric::TriangleMesh larger = ball;
  larger.vertices.front() *= 1.5;
  const ConvexPartsLimits one{2e-4, 1};
  expect_equal(cached_convex_parts(ball), convex_parts(ball));
  expect_equal(cached_convex_parts(larger), convex_parts(larger));
  expect_equal(cached_convex_parts(larger, one), convex_parts(larger, one));
  EXPECT_TRUE(cached_convex_parts({}).empty());
}

}  // namespace
}  // namespace handway::simulate_mujoco
