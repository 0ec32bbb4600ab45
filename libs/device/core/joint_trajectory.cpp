#include "handway/device/core/joint_trajectory.h"

#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace handway::device {
namespace {

// Positions and limits from files were rounded.
constexpr double kAngleTolerance = 1e-6;
constexpr double kVelocityTolerance = 2e-3;

[[noreturn]] void refuse(const std::string& element, std::string found, std::string expected) {
  throw geometric::InputError({"trajectory", element, std::move(found), std::move(expected),
                               "Time the path for this device, and not faster than it goes."});
}

void check_shape(const JointTrajectory& trajectory, const JointRanges& joints) {
  const auto points = static_cast<Eigen::Index>(trajectory.times.size());
  if (points < 2) {
    refuse("", fmt::format("{} points", points), "two or more");
  }
  if (trajectory.positions.rows() != points || trajectory.positions.cols() != joints.count()) {
    refuse(
        "",
        fmt::format("{} by {} positions", trajectory.positions.rows(), trajectory.positions.cols()),
        fmt::format("{} points of {} joints", points, joints.count()));
  }
  if (trajectory.times.front() != 0.0) {
    refuse("point 1", fmt::format("time {} s", trajectory.times.front()), "0 s");
  }
}

void check_point(const JointTrajectory& trajectory, const JointRanges& joints, Eigen::Index point) {
  const auto at = static_cast<std::size_t>(point);
  const double step = point == 0 ? 1.0 : trajectory.times[at] - trajectory.times[at - 1];
  if (!(std::isfinite(step) && step > 0.0)) {
    refuse(fmt::format("point {}", point + 1), fmt::format("time {} s", trajectory.times[at]),
           "a time later than the point before");
  }
  for (Eigen::Index j = 0; j < joints.count(); ++j) {
    const double q = trajectory.positions(point, j);
    const std::string element =
        fmt::format("point {}, joint {}", point + 1, joints.names[static_cast<std::size_t>(j)]);
    if (!(q >= joints.lower[j] - kAngleTolerance && q <= joints.upper[j] + kAngleTolerance)) {
      refuse(element, fmt::format("{:.6f} rad", q),
             fmt::format("{:.6f} to {:.6f} rad", joints.lower[j], joints.upper[j]));
    }
    const double velocity =
        point == 0 ? 0.0 : std::abs(q - trajectory.positions(point - 1, j)) / step;
    if (velocity > joints.velocity[j] * (1.0 + kVelocityTolerance)) {
      refuse(element, fmt::format("{:.6f} rad/s", velocity),
             fmt::format("{:.6f} rad/s or less", joints.velocity[j]));
    }
  }
}

}  // namespace

Eigen::VectorXd JointTrajectory::at(double time) const {
  const auto later = std::upper_bound(times.begin(), times.end(), time);
  if (later == times.begin()) {
    return positions.row(0);
  }
  if (later == times.end()) {
    return positions.row(positions.rows() - 1);
  }
  const Eigen::Index next = later - times.begin();
  const double begin = *(later - 1);
  const double share = (time - begin) / (*later - begin);
  return (1.0 - share) * positions.row(next - 1) + share * positions.row(next);
}

void check_trajectory(const JointTrajectory& trajectory, const JointRanges& joints) {
  check_shape(trajectory, joints);
  for (Eigen::Index point = 0; point < trajectory.positions.rows(); ++point) {
    check_point(trajectory, joints, point);
  }
}

}  // namespace handway::device
