#include "handway/device/tracker/workspace_limits.h"

#include <cmath>
#include <stdexcept>

namespace handway::device {

namespace {

constexpr int kMostProjections = 200;
constexpr double kClose = 1e-6;

Eigen::Vector3d in_box(const WorkspaceLimits& limits, const Eigen::Vector3d& point) {
  return point.cwiseMax(limits.box.min()).cwiseMin(limits.box.max());
}

Eigen::Vector3d in_ball(const WorkspaceLimits& limits, const Eigen::Vector3d& point) {
  const Eigen::Vector3d from_centre = point - limits.reach_centre;
  const double distance = from_centre.norm();
  return distance <= limits.reach
             ? point
             : Eigen::Vector3d(limits.reach_centre + from_centre * (limits.reach / distance));
}

}  // namespace

void check_workspace(const WorkspaceLimits& limits) {
  if (limits.box.min().hasNaN() || limits.box.max().hasNaN() || limits.box.isEmpty()) {
    throw std::invalid_argument("a workspace's box has to have its lower corner below the upper");
  }
  if (!(limits.reach > 0.0) || !limits.reach_centre.allFinite()) {
    throw std::invalid_argument("a workspace's reach has to be above 0, its centre finite");
  }
  if ((in_box(limits, limits.reach_centre) - limits.reach_centre).norm() >= limits.reach) {
    throw std::invalid_argument("a workspace's box has to be within reach");
  }
}

Eigen::Vector3d nearest_inside(const WorkspaceLimits& limits, const Eigen::Vector3d& point) {
  // Alternating projections onto two convex sets with a common point come as near to both as
  // one likes (von Neumann 1933; Bregman 1965).
  Eigen::Vector3d inside = point;
  for (int k = 0; k < kMostProjections; ++k) {
    const Eigen::Vector3d ball = in_ball(limits, inside);
    inside = in_box(limits, ball);
    if ((inside - ball).norm() < kClose) {
      break;
    }
  }
  return inside;
}

}  // namespace handway::device
