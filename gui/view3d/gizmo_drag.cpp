#include "view3d/gizmo_drag.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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
    case GizmoHandle::Kind::kBody:
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

Vector3d GizmoDrag::snapped(const Vector3d& amount) const {
  return {snapped_step(0, amount.x()), snapped_step(1, amount.y()), amount.z()};
}

Pose GizmoDrag::moved_by(const Vector3d& amount) {
  for (int axis = 0; axis < 3; ++axis) {
    amount_[axis] = is_free(axis) ? amount[axis] : 0.0;
  }
  Pose moved = X_WO_;
  if (handle_.kind == GizmoHandle::Kind::kRing) {
    const Eigen::Translation3d centre(frame_.centre);
    moved = centre * Eigen::AngleAxisd(amount_[handle_.axis], frame_.axes.col(handle_.axis)) *
            centre.inverse() * X_WO_;
  } else {
    moved.translation() += frame_.axes * amount_;
  }
  return moved;
}

}  // namespace handway::gui
