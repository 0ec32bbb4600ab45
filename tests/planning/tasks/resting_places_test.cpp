#include "handway/planning/tasks/resting_places.h"

#include "handway/geometric/setup/placing.h"
#include "handway_test/input_errors.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace handway::planning {
namespace {

using Eigen::Vector3d;
using geometric::Pose;
using geometric::SceneObject;
using ::testing::HasSubstr;

Pose at(double x, double y, double z) { return Pose(Eigen::Translation3d(x, y, z)); }

SceneObject box(const std::string& name, const Vector3d& size, const Pose& X_WO) {
  SceneObject object;
  object.name = name;
  object.shape = geometric::Box{size};
  object.X_PO = X_WO;
  return object;
}

geometric::Scene scene_of(std::vector<SceneObject> objects) {
  geometric::Scene scene;
  scene.objects = std::move(objects);
  return scene;
}

TEST(RestingPlaces, HaveAllOfTheUndersideAboveTheFace) {
  const SceneObject brick = box("brick", {0.1, 0.06, 0.04}, at(2, 2, 2));
  const geometric::Scene scene = scene_of({box("table", {0.4, 0.3, 0.1}, at(1, 0, 0.5)), brick});
  const std::vector<Pose> places = resting_places(scene, brick, "table", 50, 1);
  ASSERT_EQ(places.size(), 50U);
  std::set<double> turns;
  for (const Pose& X : places) {
    for (const double x : {-0.05, 0.05}) {
      for (const double y : {-0.03, 0.03}) {
        const Vector3d corner = X * Vector3d(x, y, -0.02);
        EXPECT_LE(std::abs(corner.x() - 1.0), 0.2 + 1e-9);
        EXPECT_LE(std::abs(corner.y()), 0.15 + 1e-9);
        EXPECT_NEAR(corner.z(), 0.55 + geometric::kRestingGap, 1e-9);
      }
    }
    turns.insert(std::atan2(X.linear()(1, 0), X.linear()(0, 0)));
  }
  EXPECT_GT(turns.size(), 40U) << "turned about the vertical";
}

TEST(RestingPlaces, AreOnAnyBoardOfAShelf) {
  geometric::TriangleMesh shelf;
  for (const double z : {0.2, 0.6, 1.0}) {
    append(shelf,
           transformed(*geometric::tessellate(geometric::Box{{0.5, 0.5, 0.02}}), at(0, 0, z)));
  }
  SceneObject boards;
  boards.name = "shelf";
  geometric::Mesh mesh;
  mesh.triangles = std::make_shared<const geometric::TriangleMesh>(shelf);
  boards.shape = mesh;
  const SceneObject brick = box("brick", {0.1, 0.1, 0.1}, at(2, 2, 2));
  std::set<int> heights;
  for (const Pose& X : resting_places(scene_of({boards, brick}), brick, "shelf", 40, 1)) {
    heights.insert(static_cast<int>(std::lround(100.0 * (X.translation().z() - 0.06))));
  }
  EXPECT_EQ(heights, (std::set<int>{20, 60, 100}));
}

TEST(RestingPlaces, KeepTheObjectsOrientation) {
  Pose lying = at(0, 0, 1);
  lying.rotate(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitX()));
  SceneObject bottle;
  bottle.name = "bottle";
  bottle.shape = geometric::Cylinder{0.03, 0.2};
  bottle.X_PO = lying;
  const geometric::Scene scene = scene_of({box("table", {1, 1, 0.1}, at(0, 0, 0)), bottle});
  const std::vector<Pose> places = resting_places(scene, bottle, "table", 10, 1);
  ASSERT_FALSE(places.empty());
  for (const Pose& X : places) {
    EXPECT_NEAR(X.linear().col(2).z(), 0.0, 1e-9) << "it still lies";
    EXPECT_NEAR(X.translation().z(), 0.05 + 0.03 + geometric::kRestingGap, 1e-3);
  }
}

TEST(RestingPlaces, AreNoneOnSmallOrSteepFaces) {
  const SceneObject brick = box("brick", {0.1, 0.1, 0.1}, at(2, 2, 2));
  Pose tilted = at(0, 0, 0);
  tilted.rotate(Eigen::AngleAxisd(0.5, Vector3d::UnitX()));
  const geometric::Scene scene = scene_of(
      {box("post", {0.05, 0.05, 1}, at(0, 0, 0)), box("ramp", {1, 1, 0.1}, tilted), brick});
  EXPECT_TRUE(resting_places(scene, brick, "post", 10, 1).empty());
  EXPECT_TRUE(resting_places(scene, brick, "ramp", 10, 1).empty());
  EXPECT_THAT(
      test::refusal_of([&] { static_cast<void>(resting_places(scene, brick, "rmap", 10, 1)); }),
      HasSubstr("There are: post, ramp, brick"));
}

}  // namespace
}  // namespace handway::planning
