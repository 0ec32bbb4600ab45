#include "handway/planning/tasks/palm_line.h"

#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/arm_inverse_kinematics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace handway::planning {
namespace {

using Eigen::Vector3d;
using geometric::Pose;

constexpr double kLongestStep = 5e-3;  // m, of the palm between two waypoints
constexpr int kMostSteps = 4096;
constexpr double kLargestJump = 0.5;  // rad or m: more between waypoints is another branch

// Distance of a point from the segment from `p` to `p + shift`.
double distance_from_segment(const Vector3d& point, const Vector3d& p, const Vector3d& shift) {
  const double length = shift.squaredNorm();
  const double share = length == 0.0 ? 0.0 : std::clamp((point - p).dot(shift) / length, 0.0, 1.0);
  return (point - p - share * shift).norm();
}

// The sum of the motions of all joints, rad: a slide of a length turns by it over `radius`.
double turn_between(const geometric::RobotModel& model, const Configuration& a,
                    const Configuration& b, double radius) {
  double turn = 0.0;
  for (int v = 0; v < model.variable_count(); ++v) {
    const bool slides = model.variable(v).type == geometric::JointType::kPrismatic;
    turn += std::abs(b[v] - a[v]) / (slides ? radius : 1.0);
  }
  return turn;
}

// The line in `steps` parts.
PalmLine line_in_steps(const geometric::RobotModel& model, const PalmIk& ik, const Configuration& q,
                       const Vector3d& shift_B, double radius, int steps) {
  const Pose begin = ik.pose(q);
  PalmLine line;
  line.path.waypoints.push_back(q);
  double last_distance = 0.0;
  for (int step = 1; step <= steps; ++step) {
    const Vector3d shift = shift_B * step / steps;
    const Configuration& last = line.path.waypoints.back();
    const PalmMove move = ik.moved(last, Eigen::Translation3d(shift) * begin);
    if (!move.reached) {
      return {{},
              0.0,
              fmt::format("The arm reaches only {:.0f} of {:.0f} mm of the line",
                          geometric::millimetres(shift.norm() * (step - 1) / step),
                          geometric::millimetres(shift_B.norm()))};
    }
    if ((move.q - last).cwiseAbs().maxCoeff() > kLargestJump) {
      return {{},
              0.0,
              fmt::format("The arm has to fold over after {:.0f} of {:.0f} mm of the line",
                          geometric::millimetres(shift.norm() * (step - 1) / step),
                          geometric::millimetres(shift_B.norm()))};
    }
    const double distance =
        distance_from_segment(ik.pose(move.q).translation(), begin.translation(), shift_B);
    const double turn = turn_between(model, last, move.q, radius);
    line.deviation =
        std::max(line.deviation, std::max(distance, last_distance) + radius * turn * turn / 8.0);
    last_distance = distance;
    line.path.waypoints.push_back(move.q);
  }
  return line;
}

}  // namespace

PalmLine palm_line(const geometric::RobotModel& model, const PalmIk& ik,
                   const geometric::JointIndices& arm, const Configuration& q,
                   const Vector3d& shift_B) {
  const double radius = geometric::reach_ball(model, ik.palm(), arm, q).radius;
  int steps = std::max(1, static_cast<int>(std::ceil(shift_B.norm() / kLongestStep)));
  PalmLine line = line_in_steps(model, ik, q, shift_B, radius, steps);
  while (line.fault.empty() && line.deviation > kLineDeviation && steps < kMostSteps) {
    steps *= 2;
    line = line_in_steps(model, ik, q, shift_B, radius, steps);
  }
  if (line.fault.empty() && line.deviation > kLineDeviation) {
    return {{}, line.deviation, "The arm can't keep the palm on the line"};
  }
  return line;
}

}  // namespace handway::planning
