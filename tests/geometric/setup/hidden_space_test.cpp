/// Space that a depth camera can't see.
#include "handway/geometric/setup/hidden_space.h"

#include "handway/geometric/io/input_error.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace handway::geometric {
namespace {

DepthCamera small_camera() {
  DepthCamera camera;
  camera.focal = {100.0, 100.0};
  camera.centre = {50.0, 50.0};
  return camera;
}

/// A square plate of 0.4 m, 1 m in front of the camera: a point for each pixel that sees it.
PointCloud plate() {
  PointCloud seen;
  for (int u = 30; u <= 70; ++u) {
    for (int v = 30; v <= 70; ++v) {
      seen.points.emplace_back(0.01F * static_cast<float>(u - 50),
                               0.01F * static_cast<float>(v - 50), 1.0F);
    }
  }
  return seen;
}

constexpr double kCell = 0.05;  // m

bool has(const PointCloud& hidden, const Aabb& box, const Eigen::Vector3d& p_W) {
  return std::ranges::any_of(hidden.points, [&](const Eigen::Vector3f& point) {
    return (box.lower + point.cast<double>() - p_W).cwiseAbs().maxCoeff() <= 0.5 * kCell;
  });
}

TEST(HiddenSpace, IsTheShadowOfWhatIsSeen) {
  const Aabb box{{-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0}};
  const PointCloud hidden = hidden_cells(plate(), small_camera(), Pose::Identity(), box, kCell);
  EXPECT_EQ(hidden.cell, kCell);
  EXPECT_TRUE(has(hidden, box, {0.01, 0.01, 1.51}));
  EXPECT_TRUE(has(hidden, box, {0.33, -0.33, 1.83})) << "the shadow widens";
  EXPECT_FALSE(has(hidden, box, {0.01, 0.01, 0.51})) << "in front of the plate";
  EXPECT_FALSE(has(hidden, box, {0.51, 0.01, 1.51})) << "beside the shadow";
  EXPECT_FALSE(has(hidden, box, {0.01, 0.01, 1.01})) << "the plate itself";
  for (const Eigen::Vector3f& point : hidden.points) {
    const Eigen::Vector3d p = box.lower + point.cast<double>();
    EXPECT_GT(p.z(), 1.0 + kCell);
    EXPECT_LE(p.head<2>().cwiseAbs().maxCoeff(), 0.206 * p.z()) << "within the cone of the plate";
  }
}

TEST(HiddenSpace, TurnsWithTheCamera) {
  const Pose X_WC = pose_from_rpy({0.5, 0.0, 2.0}, 3.14159265358979, 0.0, 0.0);  // it looks down
  const Aabb box{{0.0, -0.5, 0.0}, {1.0, 0.5, 1.5}};
  const PointCloud hidden = hidden_cells(plate(), small_camera(), X_WC, box, kCell);
  EXPECT_TRUE(has(hidden, box, {0.51, 0.01, 0.51})) << "below the plate";
  EXPECT_FALSE(has(hidden, box, {0.51, 0.01, 1.26})) << "above it";
}

TEST(HiddenSpace, BehindNothingIsEmpty) {
  const Aabb box{{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}};
  EXPECT_EQ(hidden_cells({}, small_camera(), Pose::Identity(), box, kCell).size(), 0U);
  const PointCloud behind{{{0.0F, 0.0F, -1.0F}, {0.0F, 0.0F, 0.0F}}, {}, 0.0};
  EXPECT_EQ(hidden_cells(behind, small_camera(), Pose::Identity(), box, kCell).size(), 0U);
}

TEST(HiddenSpace, RefusesMoreCellsThanACloudMayHave) {
  const Aabb box{{-10.0, -10.0, -10.0}, {10.0, 10.0, 10.0}};
  EXPECT_THROW(
      static_cast<void>(hidden_cells(plate(), small_camera(), Pose::Identity(), box, 0.01)),
      InputError);
}

}  // namespace
}  // namespace handway::geometric
