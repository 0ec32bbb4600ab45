#include "model/playback/path_timeline.h"

#include "handway/planning/core/planning_problem.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace handway::gui {
namespace {

constexpr double kSame = 1e-6;  // fractions closer than this are one
// Without times: normalised joint distance per second, and how long it takes at least and at most.
constexpr double kRate = 0.35;
constexpr double kShortest = 1.5;
constexpr double kLongest = 12.0;

constexpr int kPieces = 240;

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

double PathTimeline::duration() const {
  return motion_ ? motion_->trajectory.duration()
                 : std::clamp(length() / kRate, kShortest, kLongest);
}

geometric::Configuration PathTimeline::at_time(double time) const {
  const std::vector<planning::TrajectoryPoint>& points = motion_->trajectory.points;
  const auto after = std::ranges::upper_bound(points, time, {}, &planning::TrajectoryPoint::time);
  if (after == points.end()) {
    return points.back().position;
  }
  if (after == points.begin()) {
    return points.front().position;
  }
  const planning::TrajectoryPoint& before = *std::prev(after);
  const double t = (time - before.time) / (after->time - before.time);
  return (1.0 - t) * before.position + t * after->position;
}

geometric::Configuration PathTimeline::at(double fraction) const {
  if (motion_) {
    return at_time(std::clamp(fraction, 0.0, 1.0) * duration());
  }
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
  if (motion_) {
    return motion_->waypoint_times[index] / duration();
  }
  return length() > 0.0 ? distance_[index] / length() : 0.0;
}

double PathTimeline::waypoint_at(double fraction) const {
  for (std::size_t i = 1; i < distance_.size(); ++i) {
    const double before = fraction_of(i - 1);
    const double after = fraction_of(i);
    if (fraction < after) {
      return static_cast<double>(i - 1) + (fraction - before) / (after - before);
    }
  }
  return empty() ? 0.0 : static_cast<double>(distance_.size() - 1);
}

double PathTimeline::fraction_at(double waypoint) const {
  const auto before = static_cast<std::size_t>(waypoint);
  if (before + 1 >= distance_.size()) {
    return 1.0;
  }
  const double share = waypoint - static_cast<double>(before);
  return (1.0 - share) * fraction_of(before) + share * fraction_of(before + 1);
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

PalmPath palm_path(const geometric::RobotInstance& robot, const PathTimeline& timeline, int link) {
  PalmPath result;
  std::vector<geometric::Pose> X_BL(static_cast<std::size_t>(robot.model->link_count()));
  const auto palm_at = [&](const geometric::Configuration& q) -> Eigen::Vector3d {
    robot.model->forward_kinematics(q, X_BL);
    return robot.X_WB * X_BL[static_cast<std::size_t>(link)].translation();
  };
  if (timeline.empty()) {
    return result;
  }
  for (int i = 0; i <= kPieces; ++i) {
    result.points.push_back(palm_at(timeline.at(static_cast<double>(i) / kPieces)));
  }
  for (const geometric::Configuration& q : timeline.path().waypoints) {
    result.waypoints.push_back(palm_at(q));
  }
  return result;
}

}  // namespace handway::gui
