#include "collision/triangle_contact.h"

#include <algorithm>

namespace handway::geometric {
namespace {

bool one_side(const TriangleCorners& of_plane, const TriangleCorners& other, double tolerance) {
  const Eigen::Vector3d normal = (of_plane[1] - of_plane[0]).cross(of_plane[2] - of_plane[0]);
  const double enough = tolerance * normal.norm();
  const double a = normal.dot(other[0] - of_plane[0]);
  const double b = normal.dot(other[1] - of_plane[0]);
  const double c = normal.dot(other[2] - of_plane[0]);
  return std::min({a, b, c}) > enough || std::max({a, b, c}) < -enough;
}

// Does the segment from p to q go through the triangle?
bool pierces(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const TriangleCorners& t) {
  const Eigen::Vector3d along = q - p;
  const Eigen::Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double enough = kTouch * normal.norm();
  const double before = normal.dot(p - t[0]);
  const double after = normal.dot(q - t[0]);
  if (!((before > enough && after < -enough) || (before < -enough && after > enough))) {
    return false;
  }
  // The line passes all three borders on the same side, each at a distance.
  const double length = along.norm();
  int left = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d border = t[(i + 1) % 3] - t[i];
    const double passes = along.dot((t[i] - p).cross(border));
    if (std::abs(passes) <= kTouch * length * border.norm()) {
      return false;
    }
    left += passes > 0.0 ? 1 : 0;
  }
  return left == 0 || left == 3;
}

}  // namespace

bool plane_keeps_apart(const TriangleCorners& s, const TriangleCorners& t, double tolerance) {
  return one_side(s, t, tolerance) || one_side(t, s, tolerance);
}

bool surely_cross(const TriangleCorners& s, const TriangleCorners& t) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (pierces(s[i], s[(i + 1) % 3], t) || pierces(t[i], t[(i + 1) % 3], s)) {
      return true;
    }
  }
  return false;
}

}  // namespace handway::geometric
