#include "arm_moves.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace handway::export_val3 {
namespace {

constexpr double kStill = 1e-9;       // rad: the arm stays
constexpr double kLeastShare = 1e-4;  // of a limit

void check_arm(const planning::Motion& motion) {
  const auto turns = [&](int v) {
    return motion.model->variable(v).type == geometric::JointType::kRevolute;
  };
  if (motion.arm.size() != 6 || !std::ranges::all_of(motion.arm, turns)) {
    throw geometric::InputError(
        {"robot " + motion.model->name(), "", fmt::format("an arm of {} joints", motion.arm.size()),
         "six that turn, as VAL3's jointRx has", "The group \"arm\" of the SRDF file tells them"});
  }
}

/// The speed and acceleration of the share done of a move that the joints' limits allow.
struct ShareLimits {
  double velocity = std::numeric_limits<double>::infinity();      ///< 1/s
  double acceleration = std::numeric_limits<double>::infinity();  ///< 1/s²
};

ShareLimits share_limits(const planning::Motion& motion, const geometric::Configuration& delta) {
  ShareLimits limits;
  for (const int v : motion.arm) {
    const double way = std::abs(delta[v]);
    if (way > 0.0) {
      limits.velocity = std::min(limits.velocity, motion.limits.velocity[v] / way);
      limits.acceleration = std::min(limits.acceleration, motion.limits.acceleration[v] / way);
    }
  }
  return limits;
}

/// The top speed w of a move that takes `duration` in all: 1 / w + w / acceleration.
double top_speed(double duration, double acceleration) {
  const double half = 0.5 * acceleration * duration;
  return half - std::sqrt(std::max(0.0, half * half - acceleration));
}

}  // namespace

std::vector<ArmMove> arm_moves(const planning::Motion& motion) {
  check_arm(motion);
  std::vector<ArmMove> moves;
  const double acceleration = motion.speed * motion.speed;
  for (std::size_t w = 0; w < motion.path.waypoints.size(); ++w) {
    const geometric::Configuration& q = motion.path.waypoints[w];
    ArmMove move;
    for (std::size_t i = 0; i < move.point.size(); ++i) {
      move.point[i] = geometric::degrees(q[motion.arm[i]]);
    }
    move.velocity = 100.0 * motion.speed;
    move.acceleration = 100.0 * acceleration;
    if (w > 0) {
      const double duration = motion.waypoint_times[w] - motion.waypoint_times[w - 1];
      const geometric::Configuration delta = q - motion.path.waypoints[w - 1];
      const ShareLimits limits = share_limits(motion, delta);
      if (limits.velocity > 1.0 / kStill) {
        move.pause = duration;
      } else {
        const double speed = top_speed(duration, acceleration * limits.acceleration);
        move.velocity = 100.0 * std::clamp(speed / limits.velocity, kLeastShare, motion.speed);
      }
    }
    moves.push_back(move);
  }
  return moves;
}

}  // namespace handway::export_val3
