#include "handway/execution/motion/motion_parts.h"

#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>

#include <cmath>

namespace handway::execution {
namespace {

// What a joint may turn and still count as standing, rad.
constexpr double kStillSpeed = 1e-6;

}  // namespace

planning::Configuration with_measured(planning::Configuration q,
                                      const std::vector<MotionTarget>& targets) {
  for (const MotionTarget& target : targets) {
    const Eigen::VectorXd& position = target.link->measured().position;
    for (std::size_t j = 0; j < target.variables.size(); ++j) {
      q[target.variables[j]] = position[static_cast<Eigen::Index>(j)];
    }
  }
  return q;
}

void check_that_the_rest_stands(const geometric::RobotModel& model, const planning::Path& path,
                                const std::vector<MotionTarget>& targets) {
  const planning::Configuration& first = path.waypoints.front();
  std::vector<bool> driven(static_cast<std::size_t>(first.size()));
  std::string devices;
  for (const MotionTarget& target : targets) {
    devices += (devices.empty() ? "" : ",") + target.link->name();
    for (const int v : target.variables) {
      driven[static_cast<std::size_t>(v)] = true;
    }
  }
  for (const planning::Configuration& waypoint : path.waypoints) {
    for (Eigen::Index v = 0; v < first.size(); ++v) {
      if (!driven[static_cast<std::size_t>(v)] && std::abs(waypoint[v] - first[v]) > kStillSpeed) {
        throw geometric::InputError(
            {"--to", "", devices, "devices for all joints that the path moves",
             fmt::format("Joint \"{}\" moves, and no device is there for it.",
                         model.variable(static_cast<int>(v)).name)});
      }
    }
  }
}

device::JointTrajectory part_of(const planning::Trajectory& trajectory,
                                const std::vector<int>& variables) {
  device::JointTrajectory part;
  part.positions.resize(static_cast<Eigen::Index>(trajectory.points.size()),
                        static_cast<Eigen::Index>(variables.size()));
  for (const planning::TrajectoryPoint& point : trajectory.points) {
    const auto row = static_cast<Eigen::Index>(part.times.size());
    part.times.push_back(point.time - trajectory.points.front().time);
    for (std::size_t j = 0; j < variables.size(); ++j) {
      part.positions(row, static_cast<Eigen::Index>(j)) = point.position[variables[j]];
    }
  }
  return part;
}

}  // namespace handway::execution
