#include "view3d/drawing_parts.h"

#include "view3d/shape_node.h"
#include "view3d/unlit_nodes.h"

#include <Inventor/nodes/SoComplexity.h>
#include <Inventor/nodes/SoDepthBuffer.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoMatrixTransform.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoSphere.h>
#include <Inventor/nodes/SoTranslation.h>

#include <cmath>
#include <cstddef>
#include <numbers>

namespace handway::gui {
namespace {

constexpr float kVeil = 0.14F;         // opacity of a face
constexpr int kRim = 48;               // corners of its rim
constexpr float kBeadRadius = 0.005F;  // m

}  // namespace

std::array<Eigen::Vector3d, 8> box_corners(const geometric::Pose& X_WB,
                                           const Eigen::Vector3d& half_size) {
  std::array<Eigen::Vector3d, 8> corners;
  for (std::size_t corner = 0; corner < corners.size(); ++corner) {
    const auto side = [corner](std::size_t bit) { return (corner & bit) != 0 ? 1.0 : -1.0; };
    corners[corner] = X_WB * half_size.cwiseProduct(Eigen::Vector3d(side(1), side(2), side(4)));
  }
  return corners;
}

geometric::Color mixed(const geometric::Color& a, const geometric::Color& b, float share) {
  return {a.red + share * (b.red - a.red), a.green + share * (b.green - a.green),
          a.blue + share * (b.blue - a.blue), 1.0F};
}

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

void add_open_cone(SoSeparator& parent, const Eigen::Vector3d& apex,
                   const Eigen::Vector3d& direction, double angle, double slant,
                   const geometric::Color& color) {
  const geometric::Cone cone{slant * std::sin(angle), slant * std::cos(angle)};
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors(-Eigen::Vector3d::UnitZ(), direction);
  const geometric::Pose X_WC = Eigen::Translation3d(apex + 0.5 * cone.length * direction) * turn;
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

void add_axes(SoSeparator& parent, const geometric::Pose& X_WF, double length) {
  constexpr std::array kColors{geometric::Color{0.82F, 0.18F, 0.16F, 1.0F},
                               geometric::Color{0.20F, 0.62F, 0.20F, 1.0F},
                               geometric::Color{0.16F, 0.36F, 0.82F, 1.0F}};
  for (int axis = 0; axis < 3; ++axis) {
    const std::array<Eigen::Vector3d, 2> ends{
        X_WF.translation(), X_WF * Eigen::Vector3d(length * Eigen::Vector3d::Unit(axis))};
    parent.addChild(make_edges_node(ends, Edges{{0, 1}}, kColors.at(static_cast<std::size_t>(axis)),
                                    kAxisWidth));
  }
}

SoSeparator* make_dot(const Eigen::Vector3d& point, const geometric::Color& color) {
  return make_dots_node(std::array{point}, {color}, kDotSize);
}

SoSeparator* make_bead(const Eigen::Vector3d& place, const geometric::Color& color) {
  auto* separator = new SoSeparator;
  auto* translation = new SoTranslation;
  translation->translation = to_coin(place);
  separator->addChild(translation);
  separator->addChild(make_material(color).get());
  separator->addChild(new SoComplexity);
  auto* ball = new SoSphere;
  ball->radius = kBeadRadius;
  separator->addChild(ball);
  return separator;
}

CoinRef<SoSeparator> make_seen_through() {
  auto separator = make_coin<SoSeparator>();
  auto* through = new SoDepthBuffer;
  through->test = FALSE;
  separator->addChild(through);
  return separator;
}

CoinRef<SoSeparator> make_plain_line(std::span<const Eigen::Vector3d> points,
                                     const geometric::Color& rgb, float width) {
  auto separator = make_seen_through();
  separator->addChild(make_line_node(points, {rgb}, width));
  return separator;
}

}  // namespace handway::gui
