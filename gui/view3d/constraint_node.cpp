#include "view3d/constraint_node.h"

#include "model/document/scene_edits.h"
#include "view3d/coin_conversions.h"
#include "view3d/shape_node.h"
#include "view3d/unlit_nodes.h"

#include <Inventor/nodes/SoBaseColor.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoMatrixTransform.h>
#include <Inventor/nodes/SoSeparator.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace handway::gui {
namespace {

using Edges = std::vector<std::pair<int, int>>;

constexpr geometric::Color kKeptColor{0.05F, 0.55F, 0.62F, 1.0F};
constexpr geometric::Color kViolatedColor{0.86F, 0.16F, 0.14F, 1.0F};
constexpr float kVeil = 0.14F;  // opacity of a face
constexpr float kEdgeWidth = 1.5F;
constexpr float kAxisWidth = 3.0F;
constexpr float kDotSize = 9.0F;

constexpr double kSlant = 0.25;  // m, of a cone, and the length of the axis in it
constexpr int kRim = 48;         // corners of its rim

void add_veil(SoSeparator& parent, const geometric::Shape& shape, const geometric::Pose& X_WS,
              geometric::Color color) {
  auto* veil = new SoSeparator;
  auto* place = new SoMatrixTransform;
  place->matrix = to_coin(X_WS);
  veil->addChild(place);
  color.alpha = kVeil;
  veil->addChild(make_material(color).get());
  veil->addChild(make_shape_node(shape).get());
  parent.addChild(veil);
}

// Its apex at the body's origin. What allows more than a right angle has no cone.
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
  const geometric::Cone cone{kSlant * std::sin(upright.angle), kSlant * std::cos(upright.angle)};
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors(-Eigen::Vector3d::UnitZ(), direction);
  const geometric::Pose X_WC =
      Eigen::Translation3d(X_WB.translation() + 0.5 * cone.length * direction) * turn;
  add_veil(parent, cone, X_WC, color);
  std::vector<Eigen::Vector3d> rim;
  Edges edges;
  for (int i = 0; i < kRim; ++i) {
    const double at = 2.0 * std::numbers::pi * i / kRim;
    rim.emplace_back(X_WC * Eigen::Vector3d(cone.radius * std::cos(at), cone.radius * std::sin(at),
                                            -0.5 * cone.length));
    edges.emplace_back(i, (i + 1) % kRim);
  }
  parent.addChild(make_edges_node(rim, edges, color, kEdgeWidth));
}

void add_box(SoSeparator& parent, const geometric::PositionConstraint& region,
             const geometric::Pose& X_WB) {
  const Eigen::Vector3d p_W = X_WB * region.point;
  const bool is_kept =
      ((region.X_WR.inverse() * p_W).cwiseAbs().array() <= 0.5 * region.size.array()).all();
  const geometric::Color color = is_kept ? kKeptColor : kViolatedColor;
  add_veil(parent, geometric::Box{region.size}, region.X_WR, color);
  std::vector<Eigen::Vector3d> corners;
  Edges edges;
  for (int corner = 0; corner < 8; ++corner) {  // numbered by their bits: 1 for x, 2 for y, 4 for z
    const auto side = [corner](int bit) { return (corner & bit) != 0 ? 0.5 : -0.5; };
    corners.emplace_back(region.X_WR *
                         region.size.cwiseProduct(Eigen::Vector3d(side(1), side(2), side(4))));
    for (const int bit : {1, 2, 4}) {
      if ((corner & bit) == 0) {
        edges.emplace_back(corner, corner | bit);
      }
    }
  }
  parent.addChild(make_edges_node(corners, edges, color, kEdgeWidth));
  auto* point = new SoSeparator;
  add_unlit_style(*point, 1.0F, kDotSize);
  auto* base = new SoBaseColor;
  base->rgb = to_coin(color);
  point->addChild(base);
  auto* dot = new RoundPoints;
  dot->vertexProperty = make_vertices(std::array{p_W});
  point->addChild(dot);
  parent.addChild(point);
}

}  // namespace

Drawing make_constraints_node(const geometric::Scene& scene, const geometric::Configuration& q) {
  auto separator = make_coin<SoSeparator>();
  for (const geometric::PathConstraint& constraint : scene.constraints) {
    const std::optional<geometric::Pose> X_WB = body_pose(scene, q, constraint.body);
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
