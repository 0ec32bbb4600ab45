#include "motion_window.h"

#include <algorithm>

namespace handway::device {
namespace {

constexpr double kFirst = 0.005;  // s: a point that is due at once is late when it arrives
constexpr double kApart = 1e-3;   // s, of two points, at least
constexpr double kStep = 0.01;    // s, while braking

}  // namespace

JointTrajectory motion_window(const JointTrajectory& motion, double time,
                              const WindowLength& length) {
  std::vector<double> own;
  std::vector<double> planned;
  const auto add = [&](double when, double where) {
    if (when >= kFirst && (own.empty() || when >= own.back() + kApart)) {
      own.push_back(when);
      planned.push_back(where);
    }
  };
  const double end = motion.duration();
  const double until = time + length.follow;
  const auto next = std::ranges::upper_bound(motion.times, time);
  for (auto point = next; point != motion.times.end() && *point < until; ++point) {
    add(*point - time, *point);
  }
  if (until >= end) {
    add(std::max({kFirst, end - time, own.empty() ? 0.0 : own.back() + kApart}), end);
  } else {
    for (double t = 0.0; t < length.brake - kApart; t += kStep) {
      add(length.follow + t, until + t - 0.5 * t * t / length.brake);
    }
    add(length.follow + length.brake, until + 0.5 * length.brake);
  }
  JointTrajectory window{std::move(own), Eigen::MatrixXd(static_cast<Eigen::Index>(planned.size()),
                                                         motion.positions.cols())};
  for (std::size_t i = 0; i < planned.size(); ++i) {
    window.positions.row(static_cast<Eigen::Index>(i)) = motion.at(planned[i]);
  }
  return window;
}

}  // namespace handway::device
