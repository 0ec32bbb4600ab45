#include "handway/planning/timing/joint_moves.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace handway::planning {
namespace {

constexpr double kStill = 1e-9;  // share of the velocity limit times s, below which the arm stays

Eigen::VectorXd of_arm(const Motion& motion, const geometric::Configuration& q) {
  return q(motion.arm);
}

}  // namespace

double JointMove::velocity_share(double acceleration_share) const {
  // The speed w of the share takes 1 / w + w / a in all: the smaller root is the trapezium's.
  const double a = acceleration_share * acceleration_limit;
  const double half = 0.5 * a * duration;
  const double rest = half * half - a;
  // Twice the ramp of a triangle: rounding must not make a full-speed triangle impossible.
  if (rest < -1e-9 * half * half) {
    return std::numeric_limits<double>::infinity();
  }
  return (half - std::sqrt(std::max(0.0, rest))) / velocity_limit;
}

double JointMove::duration_at(double velocity_share, double acceleration_share) const {
  const double w = velocity_share * velocity_limit;
  const double a = acceleration_share * acceleration_limit;
  return w * w > a ? 2.0 / std::sqrt(a) : 1.0 / w + w / a;
}

std::vector<JointMove> joint_moves(const Motion& motion) {
  const Eigen::VectorXd velocity = of_arm(motion, motion.limits.velocity);
  const Eigen::VectorXd acceleration = of_arm(motion, motion.limits.acceleration);
  std::vector<JointMove> moves;
  for (std::size_t w = 1; w < motion.path.waypoints.size(); ++w) {
    JointMove move;
    move.target = of_arm(motion, motion.path.waypoints[w]);
    move.duration = motion.waypoint_times[w] - motion.waypoint_times[w - 1];
    const Eigen::VectorXd change =
        (move.target - of_arm(motion, motion.path.waypoints[w - 1])).cwiseAbs();
    const double slowest = change.cwiseQuotient(velocity).maxCoeff();
    move.waits = slowest < kStill;
    move.largest_change = change.maxCoeff();
    if (!move.waits) {
      move.velocity_limit = 1.0 / slowest;
      move.acceleration_limit = 1.0 / change.cwiseQuotient(acceleration).maxCoeff();
    }
    moves.push_back(move);
  }
  return moves;
}

}  // namespace handway::planning
