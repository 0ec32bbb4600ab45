#include "view3d/picture_region.h"

#include "model/settings/orbit_camera.h"
#include "view3d/coin_conversions.h"

#include <Inventor/SbBox3f.h>
#include <Inventor/actions/SoGetBoundingBoxAction.h>

#include <Eigen/Geometry>

#include <cmath>

namespace handway::gui {
namespace {

constexpr int kMargin = 10;  // px, for lines and points, which boxes know without their widths
constexpr double kNearest = 0.01;  // m

}  // namespace

QRect region_of(SoNode& root, const OrbitCamera& camera, const QSize& pixels) {
  SoGetBoundingBoxAction action{viewport_of(pixels)};
  action.apply(&root);
  const SbBox3f box = action.getBoundingBox();
  if (box.isEmpty()) {
    return {};
  }
  const QRect all(QPoint(0, 0), pixels);
  const Eigen::Matrix3d R_CW = camera.orientation().transpose();
  const bool shrinks = camera.projection() == Projection::kPerspective;
  Eigen::AlignedBox2d covered;
  for (int corner = 0; corner < 8; ++corner) {
    const SbVec3f& p = corner % 2 == 0 ? box.getMin() : box.getMax();
    const SbVec3f& q = corner / 2 % 2 == 0 ? box.getMin() : box.getMax();
    const SbVec3f& r = corner / 4 == 0 ? box.getMin() : box.getMax();
    const Eigen::Vector3d p_C = R_CW * (Eigen::Vector3d(p[0], q[1], r[2]) - camera.position());
    if (shrinks && p_C.z() > -kNearest) {
      return all;
    }
    covered.extend(
        Eigen::Vector2d(p_C.head<2>() * (pixels.height() / camera.seen_height(-p_C.z()))));
  }
  const Eigen::Vector2d middle(0.5 * pixels.width(), 0.5 * pixels.height());
  const Eigen::Vector2d least = covered.min() + middle;
  const Eigen::Vector2d most = covered.max() + middle;
  const QRect region(QPoint(static_cast<int>(std::floor(least.x())) - kMargin,
                            static_cast<int>(std::floor(least.y())) - kMargin),
                     QPoint(static_cast<int>(std::ceil(most.x())) + kMargin,
                            static_cast<int>(std::ceil(most.y())) + kMargin));
  return region & all;
}

}  // namespace handway::gui
