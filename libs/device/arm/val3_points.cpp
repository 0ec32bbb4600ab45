#include "val3_points.h"

#include <algorithm>

namespace handway::device {
namespace {

// Nothing that moves less can be sent to an arm (float32), rad.
constexpr double kNoMove = 1e-6;
// The least share of its velocity that the controller takes.
constexpr double kLeastVelocity = 1e-4;

}  // namespace

std::vector<Val3Point> val3_points(const JointTrajectory& trajectory, const JointRanges& joints) {
  std::vector<Val3Point> points;
  double wait_until = 0.0;
  Eigen::VectorXd from = trajectory.positions.row(0);
  for (std::size_t i = 1; i < trajectory.times.size(); ++i) {
    const Eigen::VectorXd to = trajectory.positions.row(static_cast<Eigen::Index>(i));
    const double duration = trajectory.times[i] - trajectory.times[i - 1];
    if ((to - from).cwiseAbs().maxCoeff() < kNoMove) {
      wait_until = trajectory.times[i];
      continue;
    }
    const double share =
        ((to - from).cwiseAbs().array() / joints.velocity.array()).maxCoeff() / duration;
    Val3Point point;
    const std::size_t ahead = i > kVal3PointsAhead ? i - kVal3PointsAhead : 0;
    point.due = std::max(trajectory.times[ahead], wait_until);
    point.end = trajectory.times[i];
    point.message.type = SimpleMessageType::kJointTrajectoryPoint;
    point.message.kind = SimpleMessageKind::kRequest;
    point.message.sequence = static_cast<std::int32_t>(points.size());
    for (Eigen::Index j = 0; j < to.size(); ++j) {
      point.message.joints[static_cast<std::size_t>(j)] = static_cast<float>(to[j]);
    }
    point.message.velocity = static_cast<float>(std::clamp(share, kLeastVelocity, 1.0));
    point.message.duration = static_cast<float>(duration);
    points.push_back(point);
    from = to;
  }
  return points;
}

}  // namespace handway::device
