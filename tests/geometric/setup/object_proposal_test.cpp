/// Tables and what stands on them, found in the points that a camera sees from one side.
#include "handway/geometric/setup/object_proposal.h"

#include "handway/geometric/mesh/triangle_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace handway::geometric {
namespace {

using Eigen::Vector3d;

/// Points with noise on the sides of objects that face a camera. Sides that are hidden by other
/// objects have points too.
class SeenScene {
 public:
  explicit SeenScene(const Vector3d& camera) : camera_(camera) {}

  void add(const SceneObject& object) {
    const TriangleMesh mesh = transformed(*tessellate(object.shape), object.X_PO);
    for (const auto& [i, j, k] : mesh.triangles) {
      const Vector3d &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
      const Vector3d normal = (b - a).cross(c - a);
      if (normal.dot(camera_ - a) > 0.0) {
        sample(a, b, c, 0.5 * normal.norm());
      }
    }
  }
  [[nodiscard]] const PointCloud& cloud() const { return cloud_; }

 private:
  void sample(const Vector3d& a, const Vector3d& b, const Vector3d& c, double area) {
    constexpr double kPerArea = 2.0e5;  // points per m²
    std::uniform_real_distribution<double> share(0.0, 1.0);
    std::normal_distribution<double> noise(0.0, 0.001);
    const int count = static_cast<int>(kPerArea * area + share(random_));
    for (int i = 0; i < count; ++i) {
      double u = share(random_), v = share(random_);
      if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      const Vector3d p =
          a + u * (b - a) + v * (c - a) + Vector3d(noise(random_), noise(random_), noise(random_));
      cloud_.points.push_back(p.cast<float>());
      cloud_.colors.push_back({255, 0, 0});
    }
  }

  Vector3d camera_;
  PointCloud cloud_;
  std::mt19937 random_{1};
};

SceneObject object(const Shape& shape, const Vector3d& place, double yaw = 0.0) {
  SceneObject made;
  made.shape = shape;
  made.X_PO = pose_from_rpy(place, 0.0, 0.0, yaw);
  return made;
}

TEST(ObjectProposal, FindsATableAndWhatStandsOnIt) {
  const std::vector<SceneObject> real = {object(Box{{0.8, 1.2, 0.03}}, {0.9, 0.1, 0.685}, 0.3),
                                         object(Cylinder{0.033, 0.12}, {0.8, 0.0, 0.76}),
                                         object(Box{{0.2, 0.1, 0.15}}, {1.0, 0.35, 0.775}, 0.9),
                                         object(Sphere{0.05}, {0.9, -0.3, 0.75})};
  SeenScene seen({2.4, 0.5, 1.6});
  for (const SceneObject& each : real) {
    seen.add(each);
  }
  const std::vector<SceneObject> found = propose_objects(seen.cloud(), Pose::Identity());
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].name, "surface");
  const Vector3d table = std::get<Box>(found[0].shape).size;
  EXPECT_NEAR(std::max(table.x(), table.y()), 1.2, 0.02);
  EXPECT_NEAR(std::min(table.x(), table.y()), 0.8, 0.02);
  EXPECT_NEAR(found[0].X_PO.translation().z() + 0.5 * table.z(), 0.7, 0.003);
  EXPECT_NEAR(found[0].color.red, 1.0, 1e-6);
  for (const SceneObject& each : real) {
    const auto same = std::ranges::find_if(found, [&](const SceneObject& other) {
      return other.shape.index() == each.shape.index() && other.name == "object" &&
             (other.X_PO.translation() - each.X_PO.translation()).norm() < 0.01;
    });
    if (const auto* can = std::get_if<Cylinder>(&each.shape)) {
      ASSERT_NE(same, found.end());
      EXPECT_NEAR(std::get<Cylinder>(same->shape).radius, can->radius, 0.003);
      EXPECT_NEAR(std::get<Cylinder>(same->shape).length, can->length, 0.005);
    } else if (const auto* ball = std::get_if<Sphere>(&each.shape)) {
      ASSERT_NE(same, found.end());
      EXPECT_NEAR(std::get<Sphere>(same->shape).radius, ball->radius, 0.003);
    } else if (&each != &real.front()) {
      ASSERT_NE(same, found.end());
      const Vector3d size = std::get<Box>(same->shape).size;
      EXPECT_NEAR(std::max(size.x(), size.y()), 0.2, 0.01);
      EXPECT_NEAR(std::min(size.x(), size.y()), 0.1, 0.01);
      EXPECT_NEAR(size.z(), 0.15, 0.01);
    }
  }
}

TEST(ObjectProposal, IsEmptyWithoutALevelSurface) {
  EXPECT_TRUE(propose_objects({}, Pose::Identity()).empty());
  SeenScene wall({2.0, 0.0, 1.0});
  wall.add(object(Box{{0.05, 2.0, 2.0}}, {0.0, 0.0, 1.0}));
  // Only its front is seen from there: its top is lower than a surface may be narrow.
  EXPECT_TRUE(propose_objects(wall.cloud(), Pose::Identity()).empty());
  // This wall is a surface if the pose of the cloud lays it down.
  EXPECT_EQ(propose_objects(wall.cloud(), pose_from_rpy({0, 0, 0}, 0.0, -M_PI / 2.0, 0.0)).size(),
            1U);
}

}  // namespace
}  // namespace handway::geometric
