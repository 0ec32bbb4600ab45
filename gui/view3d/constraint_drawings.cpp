#include "view3d/constraint_drawings.h"

#include "handway/geometric/mesh/shape.h"
#include "handway/planning/edits/scene_edits.h"
#include "view3d/coin_conversions.h"
#include "view3d/drawing_parts.h"
#include "view3d/unlit_nodes.h"

#include <Inventor/nodes/SoSeparator.h>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace handway::gui {
namespace {

constexpr geometric::Color kKeptColor{0.05F, 0.55F, 0.62F, 1.0F};
constexpr double kSlant = 0.25;  // m, of a cone, and the length of the axis in it

// Adds a cone with its apex at the body's origin. A constraint that allows more than a right angle
// has no cone.
void add_cone(SoSeparator& parent, const geometric::OrientationConstraint& upright,
              const geometric::Pose& X_WB) {
  const Eigen::Vector3d direction = upright.direction.normalized();
  const Eigen::Vector3d axis = X_WB.linear() * upright.axis.normalized();
  const double angle = std::atan2(axis.cross(direction).norm(), axis.dot(direction));
  const geometric::Color color = angle <= upright.angle ? kKeptColor : kViolatedColor;
  const std::array<Eigen::Vector3d, 2> ends{X_WB.translation(),
                                            X_WB.translation() + 1.15 * kSlant * axis};
  parent.addChild(make_edges_node(ends, Edges{{0, 1}}, color, kAxisWidth));
  if (upright.angle >= 0.5 * std::numbers::pi) {
    return;
  }
  add_open_cone(parent, X_WB.translation(), direction, upright.angle, kSlant, color);
}

void add_box(SoSeparator& parent, const geometric::PositionConstraint& region,
             const geometric::Pose& X_WB) {
  const Eigen::Vector3d p_W = X_WB * region.point;
  const bool is_kept =
      ((region.X_WR.inverse() * p_W).cwiseAbs().array() <= 0.5 * region.size.array()).all();
  const geometric::Color color = is_kept ? kKeptColor : kViolatedColor;
  add_veil(parent, geometric::Box{region.size}, region.X_WR, color);
  parent.addChild(
      make_edges_node(box_corners(region.X_WR, 0.5 * region.size), kBoxEdges, color, kEdgeWidth));
  parent.addChild(make_dot(p_W, color));
}

}  // namespace

Drawing make_constraints_node(const geometric::Scene& scene, const geometric::Configuration& q) {
  auto separator = make_coin<SoSeparator>();
  for (const geometric::PathConstraint& constraint : scene.constraints) {
    const std::optional<geometric::Pose> X_WB = planning::body_pose(scene, q, constraint.body);
    if (!X_WB) {
      continue;
    }
    if (const auto* upright = std::get_if<geometric::OrientationConstraint>(&constraint.what)) {
      add_cone(*separator.get(), *upright, *X_WB);
    } else {
      add_box(*separator.get(), std::get<geometric::PositionConstraint>(constraint.what), *X_WB);
    }
  }
  return separator;
}

}  // namespace handway::gui
