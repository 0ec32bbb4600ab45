#include "handway/execution/guidance/guided_motion.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace handway::execution {

GuidedMotion::GuidedMotion(planning::Path path, Eigen::VectorXd velocity)
    : path_(std::move(path)), velocity_(std::move(velocity)) {
  if (path_.empty() || !(velocity_.array() > 0.0).all()) {
    throw std::invalid_argument("a guided motion needs a path, and velocities above 0");
  }
  for (std::size_t i = 0; i < path_.waypoints.size(); ++i) {
    if (path_.waypoints[i].size() != velocity_.size()) {
      throw std::invalid_argument("a waypoint of another size than the velocities");
    }
    if (i > 0) {
      durations_.push_back((path_.waypoints[i] - path_.waypoints[i - 1])
                               .cwiseAbs()
                               .cwiseQuotient(velocity_)
                               .maxCoeff());
    }
  }
}

double GuidedMotion::advance(double target, double dt) {
  const double goal = std::clamp(target, 0.0, static_cast<double>(durations_.size()));
  const bool forwards = goal > place_;
  while (dt > 0.0 && place_ != goal) {
    const double next = forwards ? std::min(goal, std::floor(place_) + 1.0)
                                 : std::max(goal, std::ceil(place_) - 1.0);
    const double edge = forwards ? std::floor(place_) : std::ceil(place_) - 1.0;
    const double duration = durations_[static_cast<std::size_t>(edge)];
    const double needed = std::abs(next - place_) * duration;
    if (needed > dt) {
      place_ += (forwards ? dt : -dt) / duration;
      return place_;
    }
    place_ = next;
    dt -= needed;
  }
  return place_;
}

}  // namespace handway::execution
