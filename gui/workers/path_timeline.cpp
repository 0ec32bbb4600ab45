#include "workers/path_timeline.h"

#include "handway/planning/core/planning_problem.h"

#include <algorithm>
#include <utility>

namespace handway::gui {
namespace {

constexpr double kSame = 1e-6;  // fractions closer than this are one

}  // namespace

PathTimeline::PathTimeline(const geometric::RobotModel& model, planning::Path path)
    : path_(std::move(path)) {
  double distance = 0.0;
  for (std::size_t i = 0; i < path_.waypoints.size(); ++i) {
    if (i > 0) {
      distance += planning::normalised_distance(model, path_.waypoints[i - 1], path_.waypoints[i]);
    }
    distance_.push_back(distance);
  }
}

geometric::Configuration PathTimeline::at(double fraction) const {
  const double wanted = std::clamp(fraction, 0.0, 1.0) * length();
  const auto after = std::ranges::upper_bound(distance_, wanted);
  if (after == distance_.end()) {
    return path_.waypoints.back();
  }
  const auto i = static_cast<std::size_t>(after - distance_.begin());
  const double t = (wanted - distance_[i - 1]) / (distance_[i] - distance_[i - 1]);
  return (1.0 - t) * path_.waypoints[i - 1] + t * path_.waypoints[i];
}

double PathTimeline::fraction_of(std::size_t index) const {
  return length() > 0.0 ? distance_[index] / length() : 0.0;
}

double PathTimeline::next_waypoint(double fraction) const {
  for (std::size_t i = 0; i < distance_.size(); ++i) {
    if (fraction_of(i) > fraction + kSame) {
      return fraction_of(i);
    }
  }
  return 1.0;
}

double PathTimeline::previous_waypoint(double fraction) const {
  for (std::size_t i = distance_.size(); i-- > 0;) {
    if (fraction_of(i) < fraction - kSame) {
      return fraction_of(i);
    }
  }
  return 0.0;
}

}  // namespace handway::gui
