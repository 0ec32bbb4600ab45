#include "model/settings/orbit_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace handway::gui {
namespace {

// Place in the picture; the visible part is [-1, 1] in both directions.
Eigen::Vector2d projected(const OrbitCamera& camera, const Eigen::Vector3d& p_W, double aspect) {
  const Eigen::Vector3d p_C = camera.orientation().transpose() * (p_W - camera.position());
  const double half = -p_C.z() * std::tan(OrbitCamera::kFieldOfView / 2.0);
  return {p_C.x() / (half * aspect), p_C.y() / half};
}

TEST(OrbitCamera, FitsAllPointsIntoThePicture) {
  const std::vector<Eigen::Vector3d> points{
      {0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 1.5}, {1, 1, 1}};
  for (const StandardView view :
       {StandardView::kFront, StandardView::kTop, StandardView::kLeft, StandardView::kOblique}) {
    for (const double aspect : {0.6, 1.8}) {
      OrbitCamera camera;
      camera.look_from(view);
      camera.fit(points, aspect);
      double widest = 0.0;
      for (const Eigen::Vector3d& point : points) {
        widest = std::max(widest, projected(camera, point, aspect).cwiseAbs().maxCoeff());
      }
      EXPECT_LE(widest, 1.0);
      EXPECT_GT(widest, 0.8) << "no closer than needed, no farther either";
    }
  }
}

TEST(OrbitCamera, SeesWhatItWasFittedToAndNothingBesideOrBehind) {
  const std::vector<Eigen::Vector3d> points{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 1.5}};
  for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
    OrbitCamera camera;
    camera.set_projection(projection);
    camera.fit(points, 1.5);
    EXPECT_TRUE(camera.sees(points, 1.5));
    EXPECT_FALSE(camera.sees(std::vector<Eigen::Vector3d>{{0, 9, 0}}, 1.5));
    const Eigen::Vector3d behind = camera.position() + 0.1 * camera.orientation().col(2);
    EXPECT_FALSE(camera.sees(std::vector<Eigen::Vector3d>{behind}, 1.5));
  }
}

TEST(OrbitCamera, KeepsThePointUnderTheCursorWhenItZooms) {
  OrbitCamera camera;
  const Eigen::Matrix3d R = camera.orientation();
  const double height =
      2.0 * camera.placement().distance * std::tan(OrbitCamera::kFieldOfView / 2.0);
  const Eigen::Vector3d under =
      camera.placement().target + height * (0.2 * R.col(0) + 0.1 * R.col(1));
  const Eigen::Vector2d before = projected(camera, under, 1.0);
  camera.zoom(0.7, 0.2, 0.1);
  EXPECT_LT((projected(camera, under, 1.0) - before).norm(), 1e-12);
}

TEST(OrbitCamera, NeverTipsOver) {
  OrbitCamera camera;
  camera.orbit(0.3, 10.0);
  EXPECT_GT(camera.orientation()(2, 1), 0.0) << "up stays up";
}

}  // namespace
}  // namespace handway::gui
