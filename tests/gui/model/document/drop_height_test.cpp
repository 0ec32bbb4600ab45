#include "handway/geometric/setup/placing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace handway::test {
namespace {

using geometric::Box;
using geometric::Pose;
using geometric::Scene;
using geometric::SceneObject;
using geometric::Shape;

SceneObject object(const std::string& name, const Shape& shape, double x, double y, double z) {
  SceneObject made;
  made.name = name;
  made.shape = shape;
  made.X_PO.translation() = Eigen::Vector3d(x, y, z);
  return made;
}

Scene with_table() {
  Scene scene;
  scene.objects.push_back(object("table", Box{{1.0, 1.0, 0.04}}, 0.0, 0.0, 0.72));
  return scene;
}

// NaN, which is near nothing, where there is none.
double gap(const Scene& scene, const SceneObject& upper) {
  return geometric::gap_to_support(scene, upper).value_or(std::numeric_limits<double>::quiet_NaN());
}

TEST(GapToSupport, IsTheDistanceToTheTable) {
  const SceneObject cup = object("cup", geometric::Cylinder{0.03, 0.1}, 0.2, 0.1, 1.0);
  EXPECT_NEAR(gap(with_table(), cup), 1.0 - 0.05 - 0.74, 1e-9);
}

TEST(GapToSupport, IsNegativeForWhatHasSunkIn) {
  const SceneObject cup = object("cup", Box{{0.1, 0.1, 0.2}}, 0.0, 0.0, 0.81);
  EXPECT_NEAR(gap(with_table(), cup), -0.03, 1e-9);
}

TEST(GapToSupport, IsNothingBesideOrBelowTheTable) {
  const SceneObject beside = object("beside", Box{{0.1, 0.1, 0.1}}, 2.0, 0.0, 1.0);
  EXPECT_FALSE(geometric::gap_to_support(with_table(), beside));
  EXPECT_NEAR(geometric::height_above_floor(beside), 0.95, 1e-9);
  const SceneObject below = object("below", Box{{0.1, 0.1, 0.1}}, 0.0, 0.0, 0.5);
  EXPECT_FALSE(geometric::gap_to_support(with_table(), below));
}

// A beam across a beam: neither has a corner over the other.
TEST(GapToSupport, FindsWhereEdgesCross) {
  Scene scene;
  scene.objects.push_back(object("beam", Box{{2.0, 0.02, 0.02}}, 0.0, 0.0, 0.3));
  SceneObject across = object("across", Box{{0.02, 2.0, 0.02}}, 0.0, 0.0, 1.0);
  EXPECT_NEAR(gap(scene, across), 0.68, 1e-9);
  const double tilt = 0.3;
  across.X_PO = geometric::pose_from_rpy({0.0, 0.0, 1.0}, tilt, 0.0, 0.0);
  // Its underside sinks by 0.01 sin(tilt) / cos(tilt) at the edge of the beam.
  const double underside = 0.01 / std::cos(tilt) + 0.01 * std::tan(tilt);
  EXPECT_NEAR(gap(scene, across), 1.0 - underside - 0.31, 1e-9);
}

}  // namespace
}  // namespace handway::test
