#include "collision/volumes/inner_balls.h"

#include "collision/volumes/box_tree.h"
#include "handway/geometric/mesh/shape.h"
#include "sample_meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace handway::geometric {
namespace {

std::vector<InnerBall> balls_in(const TriangleMesh& mesh) {
  return inner_balls(mesh, TriangleTree(mesh));
}

double distance_from(const TriangleMesh& mesh, const Eigen::Vector3d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    least = std::min(least, (p - nearest_on_triangle(corners(mesh, t), p)).norm());
  }
  return least;
}

TEST(InnerBalls, AreInsideAndClearOfTheSurface) {
  for (const auto& [name, mesh] : test::sample_meshes()) {
    SCOPED_TRACE(name);
    const Aabb box = bounding_box(mesh);
    for (const InnerBall& ball : balls_in(mesh)) {
      const Eigen::Vector3d centre = ball.centre.cast<double>();
      EXPECT_GT(ball.radius, 0.0F);
      EXPECT_LT(ball.radius, distance_from(mesh, centre));
      EXPECT_TRUE((centre.array() > box.lower.array()).all() &&
                  (centre.array() < box.upper.array()).all());
    }
  }
}

TEST(InnerBalls, AreNearlyAsLargeAsFitIntoTheBody) {
  const std::vector<InnerBall> of_box = balls_in(*tessellate(Box{{0.4, 0.1, 0.06}}));
  ASSERT_FALSE(of_box.empty());
  EXPECT_GT(of_box.front().radius, 0.9F * 0.03F);
  const std::vector<InnerBall> of_can = balls_in(*tessellate(Cylinder{0.03, 0.12}));
  ASSERT_FALSE(of_can.empty());
  EXPECT_GT(of_can.front().radius, 0.8F * 0.03F);
  EXPECT_TRUE(std::ranges::is_sorted(of_can, std::ranges::greater(), &InnerBall::radius));
}

TEST(InnerBalls, AreInEveryPieceOfABody) {
  const std::vector<test::SampleMesh> samples = test::sample_meshes();
  const auto two = std::ranges::find(samples, "two balls", &test::SampleMesh::name);
  EXPECT_THAT(balls_in(two->mesh),
              ::testing::Contains(::testing::Field(
                  &InnerBall::centre,
                  ::testing::Truly([](const Eigen::Vector3f& p) { return p.x() > 0.15F; }))));
}

// The grid of centres has a limited number of points, however thin the body is.
TEST(InnerBalls, AreSoonFoundInAVeryThinBody) {
  for (const double thickness : {1e-3, 1e-6, 1e-9}) {
    const std::vector<InnerBall> balls = balls_in(*tessellate(Box{{1.0, 1.0, thickness}}));
    ASSERT_FALSE(balls.empty());
    EXPECT_LE(balls.front().radius, 0.5 * thickness);
  }
  EXPECT_FALSE(balls_in(*tessellate(Box{{1.0, 1e-9, 1e-9}})).empty());
}

TEST(InnerBalls, AreNotInAnOpenMesh) {
  TriangleMesh open = *tessellate(Box{{0.4, 0.1, 0.06}});
  open.triangles.pop_back();
  EXPECT_THAT(balls_in(open), ::testing::IsEmpty());
}

}  // namespace
}  // namespace handway::geometric
