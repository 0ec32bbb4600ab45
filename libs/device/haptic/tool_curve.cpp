#include "handway/device/haptic/tool_curve.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace handway::device {

ToolCurve::ToolCurve(std::vector<Eigen::Vector3d> points) : points_(std::move(points)) {
  if (points_.empty() ||
      !std::ranges::all_of(points_, [](const auto& p) { return p.allFinite(); })) {
    throw std::invalid_argument("a curve needs points that are finite");
  }
  arc_.push_back(0.0);
  for (std::size_t i = 1; i < points_.size(); ++i) {
    arc_.push_back(arc_.back() + (points_[i] - points_[i - 1]).norm());
  }
}

// The one with length that `s` is on. @pre length() > 0
std::size_t ToolCurve::segment(double s) const {
  const auto after = std::ranges::upper_bound(arc_, s);
  if (after != arc_.end() && after != arc_.begin()) {
    return static_cast<std::size_t>(after - arc_.begin()) - 1;
  }
  const auto end = after == arc_.end() ? std::ranges::lower_bound(arc_, length())
                                       : std::ranges::upper_bound(arc_, 0.0);
  return static_cast<std::size_t>(end - arc_.begin()) - 1;
}

Eigen::Vector3d ToolCurve::at(double s) const {
  if (length() == 0.0) {
    return points_.front();
  }
  const std::size_t i = segment(s);
  const double share = std::clamp((s - arc_[i]) / (arc_[i + 1] - arc_[i]), 0.0, 1.0);
  return points_[i] + share * (points_[i + 1] - points_[i]);
}

Eigen::Vector3d ToolCurve::tangent(double s) const {
  if (length() == 0.0) {
    return Eigen::Vector3d::Zero();
  }
  const std::size_t i = segment(s);
  return (points_[i + 1] - points_[i]) / (arc_[i + 1] - arc_[i]);
}

double ToolCurve::nearest(const Eigen::Vector3d& point, double from, double to) const {
  from = std::clamp(from, 0.0, length());
  to = std::clamp(to, from, length());
  double best = from;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    const double span = arc_[i + 1] - arc_[i];
    if (span == 0.0 || arc_[i + 1] < from || arc_[i] > to) {
      continue;
    }
    const Eigen::Vector3d way = points_[i + 1] - points_[i];
    const double s =
        std::clamp(arc_[i] + (point - points_[i]).dot(way) / span, arc_[i], arc_[i + 1]);
    const double here = std::clamp(s, from, to);
    const double distance = (points_[i] + (here - arc_[i]) / span * way - point).squaredNorm();
    if (distance < least) {
      least = distance;
      best = here;
    }
  }
  return best;
}

}  // namespace handway::device
