#include "view3d/gizmo_node.h"

#include "view3d/coin_conversions.h"
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

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace handway::gui {
using Eigen::Vector3d;
using geometric::Pose;

namespace {

constexpr int kRingParts = 72;
constexpr double kEdgeOn = 0.12;  // a plane seen flatter than this is no help

// Distance of the ray from a point, and depth of that point.
struct Nearness {
  double distance = 0.0;
  double along = 0.0;
};

Nearness nearness(const Ray& ray, const Vector3d& p) {
  const double along = ray.direction.dot(p - ray.origin);
  return {(ray.origin + along * ray.direction - p).norm(), along};
}

// Parameter of the point on `from + t direction` that is nearest to the ray.
double nearest_on_line(const Ray& ray, const Vector3d& from, const Vector3d& direction) {
  const Vector3d between = from - ray.origin;
  const double b = direction.dot(ray.direction);
  const double rest = 1.0 - b * b;
  if (rest < 1e-9) {
    return 0.0;
  }
  return (b * ray.direction.dot(between) - direction.dot(between)) / rest;
}

std::optional<Vector3d> hit_plane(const Ray& ray, const Vector3d& point, const Vector3d& normal) {
  const double slope = ray.direction.dot(normal);
  if (std::abs(slope) < 1e-6) {
    return std::nullopt;
  }
  const double along = normal.dot(point - ray.origin) / slope;
  return along > 0.0 ? std::optional<Vector3d>(ray.origin + along * ray.direction) : std::nullopt;
}

Ray in_frame(const GizmoFrame& frame, const Ray& ray) {
  return {frame.axes.transpose() * (ray.origin - frame.centre) / frame.size,
          frame.axes.transpose() * ray.direction};
}

double arrow_distance(const Ray& ray, int axis) {
  const Vector3d direction = Vector3d::Unit(axis);
  const double t = std::clamp(nearest_on_line(ray, Vector3d::Zero(), direction),
                              GizmoFrame::kArrowFrom, GizmoFrame::kArrowTo);
  return nearness(ray, t * direction).distance;
}

double ring_distance(const Ray& ray, int axis) {
  double least = 1e9;
  for (int i = 0; i < kRingParts; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRingParts;
    const Vector3d p = GizmoFrame::kRingRadius * (std::cos(angle) * Vector3d::Unit((axis + 1) % 3) +
                                                  std::sin(angle) * Vector3d::Unit((axis + 2) % 3));
    least = std::min(least, nearness(ray, p).distance);
  }
  return least;
}

bool hits_plate(const Ray& ray, int normal) {
  const auto p = hit_plane(ray, Vector3d::Zero(), Vector3d::Unit(normal));
  if (!p) {
    return false;
  }
  const auto inside = [](double x) {
    return x >= GizmoFrame::kPlateFrom && x <= GizmoFrame::kPlateTo;
  };
  return inside((*p)[(normal + 1) % 3]) && inside((*p)[(normal + 2) % 3]);
}

}  // namespace

std::optional<GizmoHandle> handle_at(const GizmoFrame& frame, const Ray& ray) {
  const Ray local = in_frame(frame, ray);
  std::optional<GizmoHandle> best;
  double least = GizmoFrame::kReach;
  const auto offer = [&](GizmoHandle::Kind kind, int axis, double distance) {
    if (distance < least) {
      least = distance;
      best = GizmoHandle{kind, axis};
    }
  };
  for (int axis = 0; axis < 3; ++axis) {
    const bool points_here = std::abs(local.direction[axis]) > 0.985;
    if (!points_here) {
      offer(GizmoHandle::Kind::kArrow, axis, arrow_distance(local, axis));
    }
    offer(GizmoHandle::Kind::kRing, axis, ring_distance(local, axis));
    if (std::abs(local.direction[axis]) > kEdgeOn && hits_plate(local, axis)) {
      offer(GizmoHandle::Kind::kPlate, axis, 0.5 * GizmoFrame::kReach);
    }
  }
  return best;
}

GizmoDrag::GizmoDrag(const GizmoHandle& handle, const GizmoFrame& frame, const Pose& X_WO,
                     const Ray& ray)
    : handle_(handle), frame_(frame), X_WO_(X_WO) {
  const Vector3d axis = frame_.axes.col(handle_.axis);
  switch (handle_.kind) {
    case GizmoHandle::Kind::kArrow:
      held_along_ = along_axis(ray);
      break;
    case GizmoHandle::Kind::kPlate:
      held_ = on_plane(ray);
      break;
    case GizmoHandle::Kind::kRing:
      if (std::abs(ray.direction.dot(axis)) < kEdgeOn) {
        // A ring that is seen from the side is pulled along like a rope.
        const Vector3d towards = -(ray.direction - ray.direction.dot(axis) * axis).normalized();
        held_ = frame_.centre + GizmoFrame::kRingRadius * frame_.size * towards;
        tangent_ = axis.cross(towards);
      }
      held_angle_ = angle_about_axis(ray);
      break;
  }
}

double GizmoDrag::along_axis(const Ray& ray) const {
  return nearest_on_line(ray, frame_.centre, frame_.axes.col(handle_.axis));
}

Vector3d GizmoDrag::on_plane(const Ray& ray) const {
  return hit_plane(ray, frame_.centre, frame_.axes.col(handle_.axis)).value_or(held_);
}

double GizmoDrag::angle_about_axis(const Ray& ray) const {
  if (!tangent_.isZero()) {
    return nearest_on_line(ray, held_, tangent_) / (GizmoFrame::kRingRadius * frame_.size);
  }
  const auto p = hit_plane(ray, frame_.centre, frame_.axes.col(handle_.axis));
  if (!p) {
    return held_angle_;
  }
  const Vector3d local = frame_.axes.transpose() * (*p - frame_.centre);
  return std::atan2(local[(handle_.axis + 2) % 3], local[(handle_.axis + 1) % 3]);
}

double GizmoDrag::snapped_step(int axis, double step) const {
  double from = 0.0;
  if (frame_.axes.isIdentity(1e-9)) {
    from = X_WO_.translation()[axis];
  }
  return std::round((from + step) / kSnapLength) * kSnapLength - from;
}

Pose GizmoDrag::moved_to(const Ray& ray, bool snap) {
  if (handle_.kind == GizmoHandle::Kind::kRing) {
    double angle = angle_about_axis(ray) - held_angle_;
    angle = tangent_.isZero() ? std::remainder(angle, 2.0 * std::numbers::pi) : angle;
    angle = snap ? std::round(angle / kSnapAngle) * kSnapAngle : angle;
    return moved_by(angle * Vector3d::Unit(handle_.axis));
  }
  Vector3d step = handle_.kind == GizmoHandle::Kind::kArrow
                      ? Vector3d((along_axis(ray) - held_along_) * Vector3d::Unit(handle_.axis))
                      : Vector3d(frame_.axes.transpose() * (on_plane(ray) - held_));
  for (int axis = 0; axis < 3; ++axis) {
    if (snap && is_free(axis)) {
      step[axis] = snapped_step(axis, step[axis]);
    }
  }
  return moved_by(step);
}

Pose GizmoDrag::moved_by(const Vector3d& amount) {
  for (int axis = 0; axis < 3; ++axis) {
    amount_[axis] = is_free(axis) ? amount[axis] : 0.0;
  }
  Pose moved = X_WO_;
  if (handle_.kind == GizmoHandle::Kind::kRing) {
    moved.linear() =
        Eigen::AngleAxisd(amount_[handle_.axis], frame_.axes.col(handle_.axis)).toRotationMatrix() *
        X_WO_.linear();
  } else {
    moved.translation() += frame_.axes * amount_;
  }
  return moved;
}

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

namespace {

constexpr std::array<geometric::Color, 3> kAxisColors{
    {{0.86F, 0.22F, 0.20F, 1.0F}, {0.18F, 0.62F, 0.24F, 1.0F}, {0.16F, 0.42F, 0.90F, 1.0F}}};
constexpr geometric::Color kHot{1.0F, 0.74F, 0.10F, 1.0F};
constexpr float kGizmoLineWidth = 2.6F;
constexpr float kHotLineWidth = 4.2F;
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
    color.alpha = 0.75F;
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
  }
  group.addChild(separator);
}

}  // namespace

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
