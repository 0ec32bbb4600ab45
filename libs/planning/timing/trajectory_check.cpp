#include "handway/planning/timing/trajectory_check.h"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <string_view>
#include <utility>

namespace handway::planning {
namespace {

using geometric::RobotModel;

constexpr double kPositionTolerance = 1e-6;  // rad or m
constexpr double kRateTolerance = 1e-3;      // of a limit
constexpr double kRest = 1e-6;               // rad/s or m/s

class Check {
 public:
  Check(const RobotModel& model, const RateLimits& limits) : model_(model), limits_(limits) {}

  std::vector<TrajectoryFault> run(const Trajectory& trajectory) {
    if (trajectory.empty()) {
      add("", 0.0, 0.0, "The trajectory has no points.");
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
  void add(const std::string& joint, double time, double value, std::string text) {
    faults_.push_back({joint, time, value, std::move(text)});
  }

  /// True for the first fault of a kind that a joint has.
  bool first(std::string_view kind, int joint) { return seen_.emplace(kind, joint).second; }

  bool check_shape(const TrajectoryPoint& point) {
    const Eigen::Index count = model_.variable_count();
    if (point.position.size() != count || point.velocity.size() != count ||
        point.acceleration.size() != count) {
      add("", point.time, static_cast<double>(point.position.size()),
          fmt::format("At {:.4f} s: {} positions, {} velocities and {} accelerations where the "
                      "robot has {} joints that move on their own.",
                      point.time, point.position.size(), point.velocity.size(),
                      point.acceleration.size(), count));
      return false;
    }
    for (int v = 0; v < count; ++v) {
      for (const double value :
           {point.time, point.position[v], point.velocity[v], point.acceleration[v]}) {
        if (!std::isfinite(value)) {
          const std::string& joint = model_.variable(v).name;
          add(joint, point.time, value,
              fmt::format("Joint {} at {:.4f} s: {} is no finite number.", joint, point.time,
                          value));
          return false;
        }
      }
    }
    return true;
  }

  void check_rest(const TrajectoryPoint& point, std::string_view what) {
    for (int v = 0; v < model_.variable_count(); ++v) {
      if (std::abs(point.velocity[v]) > kRest && first(what, v)) {
        const std::string& joint = model_.variable(v).name;
        add(joint, point.time, point.velocity[v],
            fmt::format("Joint {} {} at {:.6g} rad/s, not at rest.", joint, what,
                        point.velocity[v]));
      }
    }
  }

  void check_point(const TrajectoryPoint& point) {
    for (int link = 1; link < model_.link_count(); ++link) {
      const RobotModel::Drive& drive = model_.drive(link);
      if (drive.variable < 0) {
        continue;
      }
      const geometric::Joint& joint = model_.joint(link);
      const double value = drive.multiplier * point.position[drive.variable] + drive.offset;
      if ((value < joint.limits.lower - kPositionTolerance ||
           value > joint.limits.upper + kPositionTolerance) &&
          first("limit", link)) {
        add(joint.name, point.time, value,
            fmt::format("Joint {} at {:.4f} s: {:.6f} is outside {:.6f} to {:.6f}.", joint.name,
                        point.time, value, joint.limits.lower, joint.limits.upper));
      }
    }
    for (int v = 0; v < model_.variable_count(); ++v) {
      check_rate("velocity", v, point.time, point.velocity[v], limits_.velocity[v]);
      check_rate("acceleration", v, point.time, point.acceleration[v], limits_.acceleration[v]);
    }
  }

  void check_step(const TrajectoryPoint& before, const TrajectoryPoint& point) {
    const double step = point.time - before.time;
    if (!(step > 0.0)) {
      if (first("time", 0)) {
        add("", point.time, step,
            fmt::format("Time goes from {:.6f} s to {:.6f} s: it has to increase.", before.time,
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
    if (std::abs(value) > limit * (1.0 + kRateTolerance) && first(what, variable)) {
      const std::string& joint = model_.variable(variable).name;
      add(joint, time, value,
          fmt::format("Joint {} at {:.4f} s: {} {:.4f} is above {:.4f}.", joint, time, what,
                      std::abs(value), limit));
    }
  }

  const RobotModel& model_;
  const RateLimits& limits_;
  std::set<std::pair<std::string, int>> seen_;
  std::vector<TrajectoryFault> faults_;
};

}  // namespace

std::vector<TrajectoryFault> check_trajectory(const RobotModel& model, const Trajectory& trajectory,
                                              const RateLimits& limits) {
  return Check(model, limits).run(trajectory);
}

}  // namespace handway::planning
