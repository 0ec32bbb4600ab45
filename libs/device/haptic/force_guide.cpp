#include "handway/device/haptic/force_guide.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace handway::device {
namespace {

// A hand isn't faster, m/s: no farther is the nearest point searched, from sample to sample.
constexpr double kSearch = 0.02;  // m of the hand
// Assistance ends softly so near to the goal, m of the hand.
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
  // Where the hand's force can turn the spring, the assistance has gone.
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
