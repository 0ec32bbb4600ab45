#include "handway/device/haptic/force_guide.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace handway::device {

std::vector<geometric::BoundParameter> parameters_of(ForceGuideSettings& settings) {
  return {
      {"scale", "Scale", "", "Motion of the tool per motion of the hand", &settings.scale, 0.01,
       100.0},
      geometric::in_thousandths({"tube_mm", "Tube", "mm",
                                 "Radius around the path within which no spring pulls the hand",
                                 &settings.tube, 0.0, 100.0}),
      {"stiffness", "Stiffness", "N/m", "Stiffness of the spring towards the tube",
       &settings.stiffness, 0.0, 2000.0},
      {"damping", "Damping", "N s/m", "Damping of the hand's velocity", &settings.damping, 0.0,
       20.0},
      {"assistance", "Assistance", "N", "Force along the path", &settings.assistance, 0.0, 20.0},
      {"max_force", "Strongest force", "N", "Strongest force on the hand", &settings.strongest,
       0.01, 20.0}};
}

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

// The segment with length that contains `s`. @pre length() > 0
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
    const Eigen::Vector3d segment = points_[i + 1] - points_[i];
    const double s =
        std::clamp(arc_[i] + (point - points_[i]).dot(segment) / span, arc_[i], arc_[i + 1]);
    const double here = std::clamp(s, from, to);
    const double distance = (points_[i] + (here - arc_[i]) / span * segment - point).squaredNorm();
    if (distance < least) {
      least = distance;
      best = here;
    }
  }
  return best;
}

namespace {

// Largest speed of a hand, m/s: it bounds the search of the nearest point from sample to sample.
constexpr double kSearch = 0.02;  // m of the hand
// Distance from the goal in which assistance fades out, m of the hand.
constexpr double kGoal = 0.01;
constexpr double kArrived = 0.003;

bool makes_sense(const ForceGuideSettings& s) {
  const bool positive = s.scale > 0.0 && s.top_speed > 0.0 && s.strongest > 0.0 && s.lead > 0.0;
  const bool not_negative =
      s.tube >= 0.0 && s.stiffness >= 0.0 && s.damping >= 0.0 && s.assistance >= 0.0;
  return positive && not_negative &&
         std::isfinite(s.scale + s.strongest + s.stiffness + s.damping) && s.R_BD.isUnitary(1e-9);
}

}  // namespace

ForceGuide::ForceGuide(std::shared_ptr<const ToolCurve> curve, const ForceGuideSettings& settings)
    : curve_(std::move(curve)), settings_(settings) {
  if (!curve_ || !makes_sense(settings_)) {
    throw std::invalid_argument("a guide needs a curve, and settings that make sense");
  }
}

GuideStep ForceGuide::update(const HapticSample& sample, double followed) {
  GuideStep step;
  step.progress = progress_;
  if (!sample.button || !sample.position.allFinite() || !sample.velocity.allFinite()) {
    origin_.reset();
    return step;
  }
  const double scale = settings_.scale;
  const Eigen::Vector3d p = scale * (settings_.R_BD * sample.position);
  if (!origin_) {
    origin_ = curve_->at(progress_) - p;
    ++grips_;
  }
  const Eigen::Vector3d p_BT = *origin_ + p;
  progress_ = curve_->nearest(p_BT, progress_ - scale * kSearch, progress_ + scale * kSearch);
  const Eigen::Vector3d away = (p_BT - curve_->at(progress_)) / scale;
  const Eigen::Vector3d force = pull(away, settings_.R_BD * sample.velocity, followed);
  const double strength = force.norm();
  const double most = std::min(1.0, settings_.strongest / std::max(strength, 1e-12));
  step.force = settings_.R_BD.transpose() * (most * force);
  step.progress = progress_;
  step.deviation = away.norm();
  step.engaged = true;
  step.arrived = curve_->length() - progress_ <= scale * kArrived;
  return step;
}

// The force on the hand, N, in the base's frame.
Eigen::Vector3d ForceGuide::pull(const Eigen::Vector3d& away, const Eigen::Vector3d& velocity,
                                 double followed) const {
  Eigen::Vector3d force = -settings_.damping * velocity;
  const double distance = away.norm();
  const double outside = std::max(0.0, distance - settings_.tube);
  if (outside > 0.0) {
    force -= settings_.stiffness * outside / distance * away;
  }
  const Eigen::Vector3d tangent = curve_->tangent(progress_);
  // The assistance fades to 0 where the spring's force reaches its limit.
  const double near =
      std::clamp(1.0 - outside * settings_.stiffness / settings_.strongest, 0.0, 1.0);
  const double slow = std::clamp(1.0 - velocity.dot(tangent) / settings_.top_speed, 0.0, 1.0);
  const double left = (curve_->length() - progress_) / settings_.scale;
  force += settings_.assistance * near * slow * std::clamp(left / kGoal, 0.0, 1.0) * tangent;
  const double ahead = (progress_ - followed) / settings_.scale;
  const double too_far = std::max(0.0, std::abs(ahead) - settings_.lead);
  return force - std::copysign(settings_.stiffness * too_far, ahead) * tangent;
}

}  // namespace handway::device
