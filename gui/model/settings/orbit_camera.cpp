#include "model/settings/orbit_camera.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace handway::gui {
namespace {

constexpr double kSteepest = geometric::radians(89.9);

}  // namespace

void OrbitCamera::set_placement(const Placement& placement) {
  placement_ = placement;
  placement_.distance = std::clamp(placement.distance, 0.02, 100.0);
  placement_.elevation = std::clamp(placement.elevation, -kSteepest, kSteepest);
  placement_.azimuth = std::remainder(placement.azimuth, 2.0 * std::numbers::pi);
}

Eigen::Matrix3d OrbitCamera::orientation() const {
  const double ca = std::cos(placement_.azimuth), sa = std::sin(placement_.azimuth);
  const double ce = std::cos(placement_.elevation), se = std::sin(placement_.elevation);
  Eigen::Matrix3d R;
  R.col(0) = Eigen::Vector3d(-sa, ca, 0.0);
  R.col(1) = Eigen::Vector3d(-se * ca, -se * sa, ce);
  R.col(2) = Eigen::Vector3d(ce * ca, ce * sa, se);
  return R;
}

Eigen::Vector3d OrbitCamera::position() const {
  return placement_.target + placement_.distance * orientation().col(2);
}

double OrbitCamera::seen_height(double depth) const {
  const bool shrinks = projection_ == Projection::kPerspective;
  return 2.0 * (shrinks ? depth : placement_.distance) * std::tan(kFieldOfView / 2.0);
}

void OrbitCamera::orbit(double azimuth, double elevation) {
  Placement moved = placement_;
  moved.azimuth += azimuth;
  moved.elevation += elevation;
  set_placement(moved);
}

void OrbitCamera::pan(double right, double up) {
  const double height = seen_height(placement_.distance);
  const Eigen::Matrix3d R = orientation();
  placement_.target -= height * (right * R.col(0) + up * R.col(1));
}

void OrbitCamera::zoom(double factor, double right, double up) {
  const double before = placement_.distance;
  Placement moved = placement_;
  moved.distance *= factor;
  set_placement(moved);
  const double shift = (before - placement_.distance) / placement_.distance;
  pan(-right * shift, -up * shift);
}

void OrbitCamera::look_from(StandardView view, double front) {
  struct Direction {
    double azimuth, elevation;
  };
  const auto direction = [view]() -> Direction {
    switch (view) {
      case StandardView::kFront:
        return {0.0, 0.0};
      case StandardView::kBack:
        return {180.0, 0.0};
      case StandardView::kLeft:
        return {90.0, 0.0};
      case StandardView::kRight:
        return {-90.0, 0.0};
      case StandardView::kTop:
        return {-90.0, 90.0};
      case StandardView::kBottom:
        return {-90.0, -90.0};
      case StandardView::kOblique:
        break;
    }
    return {-55.0, 18.0};
  }();
  Placement moved = placement_;
  moved.azimuth = front + geometric::radians(direction.azimuth);
  moved.elevation = geometric::radians(direction.elevation);
  set_placement(moved);
}

void OrbitCamera::fit(std::span<const Eigen::Vector3d> points, double aspect, double margin) {
  if (points.empty()) {
    return;
  }
  if (projection_ == Projection::kPerspective) {
    fit_in_perspective(points, aspect, margin);
  } else {
    fit_in_parallel(points, aspect, margin);
  }
}

std::optional<Eigen::Vector2d> OrbitCamera::place_of(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d p = orientation().transpose() * (point - position());
  return p.z() < 0.0 ? std::optional<Eigen::Vector2d>(p.head<2>() / seen_height(-p.z()))
                     : std::nullopt;
}

bool OrbitCamera::sees(std::span<const Eigen::Vector3d> points, double aspect) const {
  return std::ranges::all_of(points, [&](const Eigen::Vector3d& point) {
    const std::optional<Eigen::Vector2d> place = place_of(point);
    return place && std::abs(place->y()) <= 0.5 && std::abs(place->x()) <= 0.5 * aspect;
  });
}

void OrbitCamera::fit_in_parallel(std::span<const Eigen::Vector3d> points, double aspect,
                                  double margin) {
  const Eigen::Matrix3d R = orientation();
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& world : points) {
    box.extend(R.transpose() * world);
  }
  const double height = margin * std::max(box.sizes().y(), box.sizes().x() / aspect);
  Placement moved = placement_;
  moved.distance = std::max(height / (2.0 * std::tan(kFieldOfView / 2.0)), 0.05);
  moved.target = R * box.center();
  set_placement(moved);
}

void OrbitCamera::fit_in_perspective(std::span<const Eigen::Vector3d> points, double aspect,
                                     double margin) {
  const Eigen::Matrix3d R = orientation();
  const double slope_y = std::tan(kFieldOfView / 2.0) / margin;
  const double slope_x = slope_y * aspect;
  // In the camera's axes a point p is inside the picture if
  // |p.x - c.x| <= slope_x (c.z - p.z), and so in y. Each of the four planes
  // bounds one combination of c; the two axes are solved apart, and the
  // farther camera is taken.
  constexpr double kFar = std::numeric_limits<double>::infinity();
  double right = -kFar, left = -kFar, top = -kFar, bottom = -kFar, nearest = -kFar;
  for (const Eigen::Vector3d& world : points) {
    const Eigen::Vector3d p = R.transpose() * world;
    right = std::max(right, p.x() / slope_x + p.z());
    left = std::max(left, -p.x() / slope_x + p.z());
    top = std::max(top, p.y() / slope_y + p.z());
    bottom = std::max(bottom, -p.y() / slope_y + p.z());
    nearest = std::max(nearest, p.z());
  }
  const double eye_z = std::max({0.5 * (right + left), 0.5 * (top + bottom), nearest + 0.05});
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& world : points) {
    centre += world / static_cast<double>(points.size());
  }
  const Eigen::Vector3d eye(0.5 * slope_x * (right - left), 0.5 * slope_y * (top - bottom), eye_z);
  Placement moved = placement_;
  const double target_z = (R.transpose() * centre).z();
  moved.distance = std::max(eye_z - target_z, 0.05);
  moved.target = R * Eigen::Vector3d(eye.x(), eye.y(), target_z);
  set_placement(moved);
}

OrbitCamera::Placement interpolate(const OrbitCamera::Placement& a, const OrbitCamera::Placement& b,
                                   double t) {
  OrbitCamera::Placement result;
  result.target = a.target + t * (b.target - a.target);
  result.distance = a.distance * std::pow(b.distance / a.distance, t);
  result.azimuth = a.azimuth + t * std::remainder(b.azimuth - a.azimuth, 2.0 * std::numbers::pi);
  result.elevation = a.elevation + t * (b.elevation - a.elevation);
  return result;
}

}  // namespace handway::gui
