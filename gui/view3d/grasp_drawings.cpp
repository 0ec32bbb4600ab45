#include "view3d/grasp_drawings.h"

#include "handway/geometric/mesh/shape.h"
#include "view3d/coin_conversions.h"
#include "view3d/drawing_parts.h"
#include "view3d/shape_node.h"
#include "view3d/unlit_nodes.h"

#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoMatrixTransform.h>
#include <Inventor/nodes/SoSeparator.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace handway::gui {
namespace {

constexpr geometric::Color kWeakestColor{0.90F, 0.42F, 0.05F, 1.0F};

// Adds a line that ends in an arrow's tip.
void add_arrow(SoSeparator& parent, const std::vector<Eigen::Vector3d>& points,
               const geometric::Color& color) {
  constexpr double kTip = 0.014;  // m
  const Eigen::Vector3d& end = points.back();
  const Eigen::Vector3d along = (end - points[points.size() - 2]).normalized();
  const geometric::Cone tip{0.35 * kTip, kTip};
  auto* separator = new SoSeparator;
  auto* place = new SoMatrixTransform;
  place->matrix =
      to_coin(geometric::Pose(Eigen::Translation3d(end) *
                              Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), along)));
  separator->addChild(place);
  separator->addChild(make_material(color).get());
  separator->addChild(make_shape_node(tip).get());
  parent.addChild(make_line_node(points, {color}, kAxisWidth));
  parent.addChild(separator);
}

// Points on most of a circle about an axis of length 1.
std::vector<Eigen::Vector3d> arc_about(const Eigen::Vector3d& centre, const Eigen::Vector3d& axis,
                                       double radius) {
  constexpr int kSteps = 40;
  const Eigen::Vector3d u = planning::tangent(axis);
  const Eigen::Vector3d v = axis.cross(u);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i <= kSteps; ++i) {
    const double at = 1.5 * std::numbers::pi * i / kSteps;
    points.emplace_back(centre + radius * (std::cos(at) * u + std::sin(at) * v));
  }
  return points;
}

}  // namespace

Drawing make_contacts_node(std::span<const Eigen::Vector3d> points) {
  auto separator = make_seen_through();
  for (const Eigen::Vector3d& point : points) {
    separator->addChild(make_bead(point, kContactColor));
  }
  return separator;
}

Drawing make_grasp_node(const geometric::Pose& X_WO, const Eigen::Vector3d& p_O,
                        const planning::Pregrasp& grasp, double friction) {
  constexpr double kConeSlant = 0.025;  // m
  constexpr double kLength = 0.12;      // m, of the arrow of a force without torque
  constexpr double kLeast = 0.1;        // share of the wrench that is worth an arrow
  CoinRef<SoSeparator> separator = make_seen_through();
  for (const planning::HandContact& touch : grasp.contacts) {
    const Eigen::Vector3d p_W = X_WO * touch.contact.p_O;
    separator->addChild(make_dot(p_W, kContactColor));
    add_open_cone(*separator.get(), p_W, -(X_WO.linear() * touch.contact.normal_O),
                  std::atan(friction), kConeSlant, kContactColor);
  }
  const Eigen::Vector3d centre = X_WO * p_O;
  const Eigen::Vector3d force = X_WO.linear() * grasp.quality.weakest.head<3>();
  const Eigen::Vector3d torque = X_WO.linear() * grasp.quality.weakest.tail<3>();
  if (force.norm() > kLeast) {
    add_arrow(*separator.get(), {centre, centre + kLength * force}, kWeakestColor);
  }
  if (torque.norm() > kLeast) {
    add_arrow(*separator.get(),
              arc_about(centre, torque.normalized(), 0.5 * kLength * torque.norm()), kWeakestColor);
  }
  return separator;
}

Drawing make_forces_node(std::span<const planning::ContactForce> forces) {
  constexpr double kLengthPerNewton = 0.015;  // m
  constexpr double kLongest = 0.09;           // m
  constexpr double kLeast = 0.05;             // N that is worth an arrow
  auto separator = make_seen_through();
  for (const planning::ContactForce& force : forces) {
    const double size = force.f_W.norm();
    if (size >= kLeast) {
      const double length = std::min(kLongest, kLengthPerNewton * size);
      add_arrow(*separator.get(), {force.p_W - length / size * force.f_W, force.p_W},
                kContactColor);
    }
  }
  return separator;
}

}  // namespace handway::gui
