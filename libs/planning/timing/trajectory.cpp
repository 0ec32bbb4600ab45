#include "handway/planning/timing/trajectory.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace handway::planning {
namespace {

using Knot = TimeLaw::Knot;

constexpr double kMostPoints = 1e7;

TrajectoryPoint at_rest(double time, const geometric::Configuration& q) {
  return {time, q, Eigen::VectorXd::Zero(q.size()), Eigen::VectorXd::Zero(q.size())};
}

TrajectoryPoint point_in_cell(const PathPiece& piece, const Knot& a, const Knot& b, double time) {
  const double t = time - a.time;
  const double acceleration = a.acceleration + a.jerk * t;
  const double way = (a.speed + (a.acceleration / 2.0 + a.jerk / 6.0 * t) * t) * t;
  const double s = std::clamp(a.s + way, a.s, b.s);
  const double speed = std::max(0.0, a.speed + (a.acceleration + a.jerk / 2.0 * t) * t);
  const Eigen::VectorXd first = piece.first_derivative(s);
  return {time, piece.position(s), speed * first,
          acceleration * first + speed * speed * piece.second_derivative(s)};
}

/// From rest to rest over `distance`.
double least_time(double distance, double velocity, double acceleration) {
  const double ramp = velocity / acceleration;
  return distance <= velocity * ramp ? 2.0 * std::sqrt(distance / acceleration)
                                     : distance / velocity + ramp;
}

}  // namespace

TrajectoryPoint point_at(const BlendedPath& path, const TimeLaw& law, double time) {
  if (law.knots.empty()) {
    return at_rest(time, path.polyline().waypoints.front());
  }
  if (time >= law.duration()) {
    return at_rest(law.duration(), path.polyline().waypoints.back());
  }
  const double t = std::max(0.0, time);
  const auto after = std::ranges::upper_bound(law.knots, t, {}, &Knot::time);
  if (after == law.knots.begin() || after == law.knots.end()) {
    return at_rest(time, path.polyline().waypoints.front());
  }
  return point_in_cell(path.pieces()[after->piece], *std::prev(after), *after, t);
}

Trajectory sample(const BlendedPath& path, const TimeLaw& law, double period) {
  const double duration = law.duration();
  if (!(period > 0.0) || duration / period > kMostPoints) {
    throw std::invalid_argument("a period above 0 is needed, and at most 10 million points");
  }
  Trajectory trajectory;
  const auto whole = static_cast<long>(std::ceil(duration / period - 1e-6));
  for (long i = 0; i < whole; ++i) {
    trajectory.points.push_back(point_at(path, law, static_cast<double>(i) * period));
  }
  if (trajectory.empty()) {
    trajectory.points.push_back(at_rest(0.0, path.polyline().waypoints.front()));
  }
  const double end = duration > 0.0 ? duration : period;
  trajectory.points.push_back(at_rest(end, path.polyline().waypoints.back()));
  return trajectory;
}

std::vector<double> waypoint_times(const BlendedPath& path, const TimeLaw& law) {
  std::vector<double> times(path.polyline().waypoints.size(), 0.0);
  std::size_t done = 1;
  const auto pass = [&](std::size_t waypoint, double time) {
    // Waypoints in the same place as the one before are passed with it.
    for (; done <= waypoint; ++done) {
      times[done] = done == waypoint ? time : times[done - 1];
    }
  };
  for (std::size_t k = 1; k < law.knots.size(); ++k) {
    const Knot& a = law.knots[k - 1];
    const Knot& b = law.knots[k];
    const PathPiece& piece = path.pieces()[b.piece];
    if (piece.is_arc() ? a.piece == b.piece && a.s < 0.5 * piece.length && b.s >= 0.5 * piece.length
                       : b.s >= piece.length * (1.0 - 1e-12)) {
      const bool before_arc = !piece.is_arc() && k + 1 < law.knots.size() &&
                              path.pieces()[law.knots[k + 1].piece].waypoint == piece.waypoint;
      if (!before_arc) {
        pass(piece.waypoint, b.time);
      }
    }
  }
  pass(times.size() - 1, law.duration());
  return times;
}

double least_duration(const Path& path, const RateLimits& limits) {
  double least = 0.0;
  for (Eigen::Index j = 0; j < limits.velocity.size() && !path.empty(); ++j) {
    double total = 0.0;
    double from = path.waypoints.front()[j];
    double last = from;
    for (std::size_t w = 1; w <= path.waypoints.size(); ++w) {
      const bool over = w == path.waypoints.size();
      const double next = over ? last : path.waypoints[w][j];
      if (over || (next - last) * (last - from) < 0.0) {  // the joint turned at `last`
        total += least_time(std::abs(last - from), limits.velocity[j], limits.acceleration[j]);
        from = last;
      }
      last = next;
    }
    least = std::max(least, total);
  }
  return least;
}

}  // namespace handway::planning
