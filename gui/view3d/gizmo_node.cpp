#include "view3d/gizmo_node.h"

#include "handway/geometric/math/pose.h"
#include "view3d/coin_conversions.h"
#include "view3d/gizmo_drag.h"
#include "view3d/unlit_nodes.h"

#include <Inventor/nodes/SoBaseColor.h>
#include <Inventor/nodes/SoComplexity.h>
#include <Inventor/nodes/SoCone.h>
#include <Inventor/nodes/SoDepthBuffer.h>
#include <Inventor/nodes/SoIndexedFaceSet.h>
#include <Inventor/nodes/SoLineSet.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoMatrixTransform.h>
#include <Inventor/nodes/SoPointSet.h>
#include <Inventor/nodes/SoRotation.h>
#include <Inventor/nodes/SoScale.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoTranslation.h>
#include <Inventor/nodes/SoVertexProperty.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace handway::gui {

using Eigen::Vector3d;
using geometric::Pose;

namespace {

const SbColor kKnobRim(0.20F, 0.22F, 0.26F);
const SbColor kPlain(1.0F, 1.0F, 1.0F);
const SbColor kHotKnob(1.0F, 0.74F, 0.10F);
constexpr float kRimSize = 11.0F;  // pixels
constexpr float kSize = 8.0F;

void add_square(SoSeparator& root, const Eigen::Vector3d& point, const SbColor& color, float size) {
  auto* square = new SoSeparator;
  add_unlit_style(*square, 1.0F, size);
  auto* paint = new SoBaseColor;
  paint->rgb = color;
  square->addChild(paint);
  auto* properties = new SoVertexProperty;
  properties->vertex = to_coin(point);
  auto* dot = new SoPointSet;
  dot->vertexProperty = properties;
  square->addChild(dot);
  root.addChild(square);
}

constexpr std::array<geometric::Color, 3> kAxisColors{
    {{0.86F, 0.22F, 0.20F, 1.0F}, {0.18F, 0.62F, 0.24F, 1.0F}, {0.16F, 0.42F, 0.90F, 1.0F}}};
constexpr geometric::Color kHot{1.0F, 0.74F, 0.10F, 1.0F};
constexpr float kGizmoLineWidth = 2.0F;
constexpr float kHotLineWidth = 3.6F;
constexpr double kTipLength = 0.17;
constexpr double kTipRadius = 0.048;
constexpr int kRingSegments = 96;

SoSeparator* plain_separator() {
  auto* separator = new SoSeparator;
  separator->renderCaching = SoSeparator::OFF;
  return separator;
}

void add_color(SoGroup& group, const geometric::Color& color) {
  auto* material = new SoMaterial;
  material->diffuseColor = to_coin(color);
  material->transparency = 1.0F - color.alpha;
  group.addChild(material);
}

void add_polyline(SoGroup& group, const std::vector<Vector3d>& points) {
  auto* properties = new SoVertexProperty;
  for (std::size_t i = 0; i < points.size(); ++i) {
    properties->vertex.set1Value(static_cast<int>(i), to_coin(points[i]));
  }
  auto* line = new SoLineSet;
  line->vertexProperty = properties;
  group.addChild(line);
}

void add_arrow(SoGroup& group, int axis) {
  const Vector3d direction = Vector3d::Unit(axis);
  add_polyline(
      group, {GizmoFrame::kArrowFrom * direction, (GizmoFrame::kArrowTo - kTipLength) * direction});
  auto* place = new SoTranslation;
  place->translation = to_coin(Vector3d((GizmoFrame::kArrowTo - 0.5 * kTipLength) * direction));
  auto* turn = new SoRotation;
  turn->rotation = SbRotation(SbVec3f(0, 1, 0), to_coin(direction));
  auto* tip = new SoCone;
  tip->bottomRadius = static_cast<float>(kTipRadius);
  tip->height = static_cast<float>(kTipLength);
  group.addChild(place);
  group.addChild(turn);
  group.addChild(tip);
}

void add_ring(SoGroup& group, int axis) {
  std::vector<Vector3d> points;
  for (int i = 0; i <= kRingSegments; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRingSegments;
    points.emplace_back(GizmoFrame::kRingRadius *
                        (std::cos(angle) * Vector3d::Unit((axis + 1) % 3) +
                         std::sin(angle) * Vector3d::Unit((axis + 2) % 3)));
  }
  add_polyline(group, points);
}

void add_plate(SoGroup& group, int normal) {
  const Vector3d u = Vector3d::Unit((normal + 1) % 3), v = Vector3d::Unit((normal + 2) % 3);
  const double a = GizmoFrame::kPlateFrom, b = GizmoFrame::kPlateTo;
  const std::array<Vector3d, 4> corners{a * u + a * v, b * u + a * v, b * u + b * v, a * u + b * v};
  auto* properties = new SoVertexProperty;
  auto* face = new SoIndexedFaceSet;
  for (int i = 0; i < 4; ++i) {
    properties->vertex.set1Value(i, to_coin(corners[static_cast<std::size_t>(i)]));
    face->coordIndex.set1Value(i, i);
  }
  face->coordIndex.set1Value(4, SO_END_FACE_INDEX);
  face->vertexProperty = properties;
  group.addChild(face);
}

void add_handle(SoGroup& group, const GizmoHandle& handle, bool hot) {
  SoSeparator* separator = plain_separator();
  add_unlit_style(*separator, hot ? kHotLineWidth : kGizmoLineWidth, 1.0F);
  geometric::Color color = hot ? kHot : kAxisColors[static_cast<std::size_t>(handle.axis)];
  using Kind = GizmoHandle::Kind;
  if (handle.kind == Kind::kPlate) {
    color.alpha = hot ? 0.9F : 0.55F;
  } else if (handle.kind == Kind::kRing && !hot) {
    color.alpha = 0.45F;
  }
  add_color(*separator, color);
  switch (handle.kind) {
    case Kind::kArrow:
      add_arrow(*separator, handle.axis);
      break;
    case Kind::kPlate:
      add_plate(*separator, handle.axis);
      break;
    case Kind::kRing:
      add_ring(*separator, handle.axis);
      break;
    case Kind::kBody:
      break;
  }
  group.addChild(separator);
}

}  // namespace

Drawing make_knobs_node(std::span<const Eigen::Vector3d> points, std::optional<int> hot) {
  auto root = make_coin<SoSeparator>();
  root->renderCaching = SoSeparator::OFF;
  auto* in_front = new SoDepthBuffer;
  in_front->test = FALSE;
  root->addChild(in_front);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool is_hot = hot == static_cast<int>(i);
    add_square(*root.get(), points[i], kKnobRim, kRimSize + (is_hot ? 2.0F : 0.0F));
    add_square(*root.get(), points[i], is_hot ? kHotKnob : kPlain, kSize + (is_hot ? 2.0F : 0.0F));
  }
  return root;
}

GizmoNode::GizmoNode()
    : root_(make_coin<SoSeparator>()),
      transform_(make_coin<SoMatrixTransform>()),
      scale_(make_coin<SoScale>()),
      handles_(make_coin<SoSeparator>()) {
  root_->renderCaching = SoSeparator::OFF;
  handles_->renderCaching = SoSeparator::OFF;
  auto* complexity = new SoComplexity;
  complexity->value = 0.8F;
  root_->addChild(transform_.get());
  root_->addChild(scale_.get());
  root_->addChild(complexity);
  root_->addChild(handles_.get());
  rebuild();
}

GizmoNode::~GizmoNode() = default;

void GizmoNode::place(const GizmoFrame& frame) {
  geometric::Pose X = geometric::Pose::Identity();
  X.linear() = frame.axes;
  X.translation() = frame.centre;
  transform_->matrix = to_coin(X);
  const auto size = static_cast<float>(frame.size);
  scale_->scaleFactor = SbVec3f(size, size, size);
}

void GizmoNode::set_hot(const std::optional<GizmoHandle>& hot, bool held) {
  if (hot != hot_ || held != held_) {
    hot_ = hot;
    held_ = held;
    rebuild();
  }
}

void GizmoNode::rebuild() {
  handles_->removeAllChildren();
  using Kind = GizmoHandle::Kind;
  for (const Kind kind : {Kind::kRing, Kind::kPlate, Kind::kArrow}) {
    for (int axis = 0; axis < 3; ++axis) {
      const GizmoHandle handle{kind, axis};
      if (!held_ || handle == hot_) {
        add_handle(*handles_.get(), handle, handle == hot_);
      }
    }
  }
}

}  // namespace handway::gui
