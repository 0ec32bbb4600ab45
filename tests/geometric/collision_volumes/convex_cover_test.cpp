#include "collision/volumes/convex_cover.h"

#include "collision/volumes/hull_gap.h"
#include "sample_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>

namespace handway::geometric {
namespace {

constexpr double kMargin = 2e-4;  // m

// Uniform on the sphere.
class RandomDirections {
 public:
  Eigen::Vector3f next() {
    return Eigen::Vector3f(normal_(engine_), normal_(engine_), normal_(engine_)).normalized();
  }

 private:
  std::mt19937_64 engine_{5};
  std::normal_distribution<float> normal_;
};

float farthest_along(const TriangleMesh& mesh, const Eigen::Vector3f& direction) {
  float most = -std::numeric_limits<float>::infinity();
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    most = std::max(most, direction.dot(vertex.cast<float>()));
  }
  return most;
}

TEST(ConvexCover, ReachesAsFarAsTheMeshLessTheMargin) {
  for (const auto& [name, mesh] : test::sample_meshes()) {
    SCOPED_TRACE(name);
    const ConvexCover hull(mesh, kMargin);
    RandomDirections directions;
    for (int i = 0; i < 2000; ++i) {
      const Eigen::Vector3f direction = directions.next();
      const float reach = direction.dot(hull.support(direction));
      const float exact = farthest_along(mesh, direction);
      EXPECT_LE(reach, exact + 1e-6F);
      EXPECT_GE(reach + hull.margin(), exact - 1e-6F);
    }
  }
}

// Extremes are the same vertex then: a triangle of them has no edge to look at.
TEST(ConvexCover, ContainsTheMeshWhereTheFirstVertexIsAnExtremeOne) {
  const Pose X = Pose(Eigen::Translation3d(0.01, 0.02, -0.013)) *
                 Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, 0.5).normalized());
  TriangleMesh mesh = transformed(*tessellate(Cylinder{0.011, 0.027}), X);
  const auto lowest =
      std::ranges::min_element(mesh.vertices, {}, [](const Eigen::Vector3d& p) { return p.sum(); });
  const auto index = static_cast<std::uint32_t>(lowest - mesh.vertices.begin());
  std::swap(mesh.vertices[0], mesh.vertices[index]);
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& vertex : triangle) {
      vertex = vertex == 0 ? index : vertex == index ? 0 : vertex;
    }
  }
  const ConvexCover hull(mesh, 2e-5);
  RandomDirections directions;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3f direction = directions.next();
    EXPECT_GE(direction.dot(hull.support(direction)) + hull.margin(),
              farthest_along(mesh, direction) - 1e-6F);
  }
}

TEST(ConvexCover, LeavesOutMostPointsOfAFineMesh) {
  const TriangleMesh ball = *tessellate(Sphere{0.03});
  EXPECT_LT(ConvexCover(ball, 0.001).point_count(), ball.vertices.size() / 2);
}

TEST(ConvexCover, HasAFewHundredPointsOfAVeryFineMesh) {
  constexpr int kVertices = 20000;
  TriangleMesh ball{{}, {{0, 1, 2}}};
  for (int i = 0; i < kVertices; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / kVertices;
    const double angle = 2.399963 * i;  // a spiral of equal spacing
    ball.vertices.push_back(0.1 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0) *
                                std::sqrt(1.0 - z * z) +
                            0.1 * z * Eigen::Vector3d::UnitZ());
  }
  const ConvexCover hull(ball, 1e-6);
  EXPECT_LE(hull.point_count(), 512U);
  EXPECT_LE(hull.margin(), 0.002F);
  RandomDirections directions;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3f direction = directions.next();
    EXPECT_GE(direction.dot(hull.support(direction)) + hull.margin(),
              farthest_along(ball, direction) - 1e-6F);
  }
}

TEST(HullGap, PartsTwoBoxesWhoseSpheresOverlap) {
  const ConvexCover box(*tessellate(Box{{0.4, 0.1, 0.02}}), kMargin);
  const Pose X_BA(Eigen::Translation3d(0.0, 0.0, 0.025));
  const float gap = hull_gap(box, box, FloatPose(X_BA, 0.25F), 1.0F).distance;
  EXPECT_LE(gap, 0.005F);
  EXPECT_GT(gap, 0.004F);
}

TEST(HullGap, FindsNoneWhereHullsMeet) {
  const ConvexCover box(*tessellate(Box{{0.4, 0.1, 0.02}}), kMargin);
  const Pose X_BA(Eigen::Translation3d(0.1, 0.0, 0.019));
  EXPECT_EQ(hull_gap(box, box, FloatPose(X_BA, 0.25F), 1.0F).distance, 0.0F);
  EXPECT_EQ(hull_gap(box, box, FloatPose(Pose::Identity(), 0.25F), 1.0F).distance, 0.0F);
}

TEST(HullGap, IsTheDistanceOfTiltedBoxesToWithinAFewPerCent) {
  const TriangleMesh mesh = *tessellate(Box{{0.4, 0.1, 0.02}});
  const ConvexCover box(mesh, kMargin);
  const Eigen::Quaterniond tilt(
      Eigen::AngleAxisd(0.5, Eigen::Vector3d(1.0, 0.3, 0.2).normalized()));
  const Eigen::Vector3d lowest = *std::ranges::min_element(
      mesh.vertices, {}, [&](const Eigen::Vector3d& corner) { return (tilt * corner).z(); });
  for (const double apart : {0.0005, 0.004, 0.03}) {
    // The lowest corner of the one box is above the middle of the other one's upper side.
    const Pose X_BA =
        Eigen::Translation3d(Eigen::Vector3d(0.0, 0.0, 0.01 + apart) - tilt * lowest) * tilt;
    const float gap = hull_gap(box, box, FloatPose(X_BA, 0.25F), 1.0F).distance;
    EXPECT_LE(gap, apart + 1e-6);
    EXPECT_GE(gap, 0.95 * apart - 1e-5);
  }
}

// A box that slides along another one, and turns on it.
TEST(HullGapAlong, KeepsTheGapOfABoxThatSlides) {
  const ConvexCover box(*tessellate(Box{{0.4, 0.1, 0.02}}), 0.0);
  const Pose X_WB = Pose::Identity();
  const Pose X_WA(Eigen::Translation3d(0.0, 0.0, 0.021));
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  const MovingHull still{box, X_WB, none, none, 0.0};
  MovingHull motion{box, X_WA, {1.0, 0.5, 0.0}, none, 0.0};
  const auto gap = [&](double half) { return hull_gap_along(motion, still, half, 0.0009); };
  EXPECT_NEAR(gap(0.1), 0.001, 1e-5);
  motion.w = {0.0, 0.0, 2.0};
  EXPECT_NEAR(gap(0.1), 0.001, 1e-5);
  motion.v.z() = 0.004;  // 0.4 mm down at one end
  EXPECT_LE(gap(0.1), 0.0006 + 1e-5);
  motion.v.z() = 0.0;
  motion.bend = 0.1;  // 0.5 mm
  EXPECT_LE(gap(0.1), 0.0005 + 1e-5);
  motion.v.z() = 0.02;
  EXPECT_EQ(gap(0.1), 0.0) << "2 mm down at one end";
}

TEST(HullGap, NeverExceedsTheDistanceOfTwoBalls) {
  constexpr float kRadius = 0.03F;
  const ConvexCover ball(*tessellate(Sphere{kRadius}), kMargin);
  const Eigen::Vector3f shift = Eigen::Vector3f(1.0F, 2.0F, -3.0F).normalized();
  for (const float apart : {0.05F, 0.061F, 0.08F, 0.5F, 3.0F}) {
    const Pose X_BA(Eigen::Translation3d((apart * shift).cast<double>()));
    const float gap = hull_gap(ball, ball, FloatPose(X_BA, kRadius), 10.0F).distance;
    // Tessellated balls keep a little more distance than round ones.
    EXPECT_LE(gap, std::max(0.0F, apart - 2.0F * kRadius + 0.002F)) << apart;
    EXPECT_GE(gap, apart - 2.0F * kRadius - 0.001F) << apart;
  }
}

}  // namespace
}  // namespace handway::geometric
