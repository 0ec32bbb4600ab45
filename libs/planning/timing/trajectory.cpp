#include "handway/planning/timing/trajectory.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/robot/limit_violation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace handway::planning {
namespace {

using Knot = TimeParameterization::Knot;

constexpr double kMostPoints = 1e7;

TrajectoryPoint at_rest(double time, const geometric::Configuration& q) {
  return {time, q, Eigen::VectorXd::Zero(q.size()), Eigen::VectorXd::Zero(q.size())};
}

TrajectoryPoint point_between(const BlendedPath& path, const Knot& a, const Knot& b, double time) {
  const PathPiece& piece = path.piece_at(0.5 * (a.s + b.s));
  const Knot at = a.after(time - a.time);
  const double s = std::clamp(at.s, a.s, b.s) - piece.begin;
  const Eigen::VectorXd first = piece.derivative(1, s);
  return {time, piece.derivative(0, s), at.speed * first,
          at.acceleration * first + at.speed * at.speed * piece.derivative(2, s)};
}

/// From rest to rest over `distance`.
double least_time(double distance, double velocity, double acceleration) {
  const double ramp = velocity / acceleration;
  return distance <= velocity * ramp ? 2.0 * std::sqrt(distance / acceleration)
                                     : distance / velocity + ramp;
}

}  // namespace

TrajectoryPoint point_at(const BlendedPath& path, const TimeParameterization& law, double time) {
  if (law.knots.empty()) {
    return at_rest(time, path.polyline().waypoints.front());
  }
  if (time >= law.duration()) {
    return at_rest(law.duration(), path.polyline().waypoints.back());
  }
  const double t = std::max(0.0, time);
  const auto after = std::ranges::upper_bound(law.knots, t, {}, &Knot::time);
  return point_between(path, *std::prev(after), *after, t);
}

Trajectory sample(const BlendedPath& path, const TimeParameterization& law, double period) {
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

Trajectory with_rests_sampled(const Trajectory& trajectory, double period) {
  constexpr double kRounding = 1e-6;  // of a period
  if (trajectory.duration() / period > kMostPoints) {
    throw geometric::InputError(
        {"the motion", "",
         fmt::format("{:g} s with points every {:g} ms", trajectory.duration(), 1e3 * period),
         "at most 10 million points", "Let the program wait for a shorter time"});
  }
  Trajectory sampled;
  for (const TrajectoryPoint& point : trajectory.points) {
    if (!sampled.empty()) {
      const double begin = sampled.points.back().time;
      const auto steps = static_cast<long>(std::ceil((point.time - begin) / period - kRounding));
      for (long i = 1; i < steps; ++i) {
        sampled.points.push_back(at_rest(begin + static_cast<double>(i) * period, point.position));
      }
    }
    sampled.points.push_back(point);
  }
  return sampled;
}

std::vector<double> waypoint_times(const BlendedPath& path, const TimeParameterization& law) {
  std::vector<double> times;
  for (const double s : path.passages()) {
    const auto passed = std::ranges::lower_bound(law.knots, s, {}, &Knot::s);
    times.push_back(passed == law.knots.end() ? law.duration() : passed->time);
  }
  times.back() = law.duration();
  return times;
}

double least_duration(const Path& path, const JointKinematicLimits& limits) {
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

namespace {

using geometric::RobotModel;

constexpr double kRateTolerance = 1e-3;  // share of a limit
constexpr double kRest = 1e-6;           // rad/s or m/s

class Check {
 public:
  Check(const RobotModel& model, const JointKinematicLimits& limits, std::span<const int> fixed)
      : model_(model), limits_(limits), fixed_(fixed) {}

  std::vector<TrajectoryFault> run(const Trajectory& trajectory) {
    if (trajectory.empty()) {
      add(0.0, 0.0, "The trajectory has no points.");
      return std::move(faults_);
    }
    for (const TrajectoryPoint& point : trajectory.points) {
      if (!check_shape(point)) {
        return std::move(faults_);
      }
    }
    check_rest(trajectory.points.front(), "begins");
    check_rest(trajectory.points.back(), "ends");
    for (std::size_t i = 0; i < trajectory.points.size(); ++i) {
      check_point(trajectory.points[i]);
      if (i > 0) {
        check_step(trajectory.points[i - 1], trajectory.points[i]);
      }
    }
    return std::move(faults_);
  }

 private:
  void add(double time, double value, std::string text) {
    faults_.push_back({"", time, value, std::move(text)});
  }
  /// @param text what comes after "Joint NAME ".
  void add_of(const std::string& joint, double time, double value, const std::string& text) {
    faults_.push_back({joint, time, value, "Joint " + joint + " " + text});
  }

  /// Returns true for the first fault of each kind of a joint.
  bool first(std::string_view kind, const std::string& joint) {
    return seen_.emplace(kind, joint).second;
  }

  bool check_shape(const TrajectoryPoint& point) {
    const Eigen::Index count = model_.variable_count();
    if (point.position.size() != count || point.velocity.size() != count ||
        point.acceleration.size() != count) {
      add(point.time, static_cast<double>(point.position.size()),
          fmt::format("At {:.4f} s: {} positions, {} velocities and {} accelerations, but the "
                      "robot has {} independent joints.",
                      point.time, point.position.size(), point.velocity.size(),
                      point.acceleration.size(), count));
      return false;
    }
    for (int v = 0; v < count; ++v) {
      for (const double value :
           {point.time, point.position[v], point.velocity[v], point.acceleration[v]}) {
        if (!std::isfinite(value)) {
          add_of(model_.variable(v).name, point.time, value,
                 fmt::format("at {:.4f} s: {} is no finite number.", point.time, value));
          return false;
        }
      }
    }
    return true;
  }

  void check_rest(const TrajectoryPoint& point, std::string_view what) {
    for (int v = 0; v < model_.variable_count(); ++v) {
      const std::string& joint = model_.variable(v).name;
      if (std::abs(point.velocity[v]) > kRest && first(what, joint)) {
        add_of(joint, point.time, point.velocity[v],
               fmt::format("{} at {:.6g} rad/s, not at rest.", what, point.velocity[v]));
      }
    }
  }

  void check_point(const TrajectoryPoint& point) {
    for (const geometric::LimitViolation& violation :
         geometric::limit_violations(model_, point.position, fixed_)) {
      if (first("limit", violation.joint)) {
        add_of(violation.joint, point.time, violation.value,
               fmt::format("at {:.4f} s: {:.6f} is outside {:.6f} to {:.6f}.", point.time,
                           violation.value, violation.lower, violation.upper));
      }
    }
    for (int v = 0; v < model_.variable_count(); ++v) {
      check_position(v, point);
      check_rate("velocity", v, point.time, point.velocity[v], limits_.velocity[v]);
      check_rate("acceleration", v, point.time, point.acceleration[v], limits_.acceleration[v]);
    }
  }

  // Limits that a file has beyond the robot's own.
  void check_position(int v, const TrajectoryPoint& point) {
    if (limits_.lower.size() == 0 || std::ranges::count(fixed_, v) > 0) {
      return;
    }
    const double value = point.position[v];
    const double lower = limits_.lower[v];
    const double upper = limits_.upper[v];
    const std::string& joint = model_.variable(v).name;
    if ((value < lower - geometric::limit_tolerance(lower) ||
         value > upper + geometric::limit_tolerance(upper)) &&
        first("limit", joint)) {
      add_of(joint, point.time, value,
             fmt::format("at {:.4f} s: {:.6f} is outside {:.6f} to {:.6f}.", point.time, value,
                         lower, upper));
    }
  }

  void check_step(const TrajectoryPoint& before, const TrajectoryPoint& point) {
    const double step = point.time - before.time;
    if (!(step > 0.0)) {
      if (first("time", "")) {
        add(point.time, step,
            fmt::format("Time goes from {:.6f} s to {:.6f} s: it must increase.", before.time,
                        point.time));
      }
      return;
    }
    for (int v = 0; v < model_.variable_count(); ++v) {
      check_rate("velocity", v, point.time, (point.position[v] - before.position[v]) / step,
                 limits_.velocity[v]);
      check_rate("acceleration", v, point.time, (point.velocity[v] - before.velocity[v]) / step,
                 limits_.acceleration[v]);
      if (limits_.jerk.size() > 0) {
        check_rate("jerk", v, point.time, (point.acceleration[v] - before.acceleration[v]) / step,
                   limits_.jerk[v]);
      }
    }
  }

  void check_rate(std::string_view what, int variable, double time, double value, double limit) {
    const std::string& joint = model_.variable(variable).name;
    if (std::abs(value) > limit * (1.0 + kRateTolerance) && first(what, joint)) {
      add_of(joint, time, value,
             fmt::format("at {:.4f} s: {} {:.4f} is above {:.4f}.", time, what, std::abs(value),
                         limit));
    }
  }

  const RobotModel& model_;
  const JointKinematicLimits& limits_;
  std::span<const int> fixed_;
  std::set<std::pair<std::string, std::string>> seen_;
  std::vector<TrajectoryFault> faults_;
};

}  // namespace

std::vector<TrajectoryFault> check_trajectory(const RobotModel& model, const Trajectory& trajectory,
                                              const JointKinematicLimits& limits,
                                              std::span<const int> fixed) {
  return Check(model, limits, fixed).run(trajectory);
}

}  // namespace handway::planning
