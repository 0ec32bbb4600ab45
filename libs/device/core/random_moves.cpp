#include "core/random_moves.h"

#include <algorithm>
#include <numeric>

namespace handway::device {
namespace {

constexpr std::size_t kParts = 24;

// Maps 0 … 1 to 0 … 1, with velocity and acceleration 0 at both ends.
double minimum_jerk(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
}

}  // namespace

MinimumJerkMoves::MinimumJerkMoves(Eigen::Index coordinates, const MovePace& pace,
                                   std::uint64_t seed)
    : pace_(pace),
      random_(seed),
      parts_(static_cast<std::size_t>(coordinates)),
      from_(Eigen::VectorXd::Zero(coordinates)),
      to_(Eigen::VectorXd::Zero(coordinates)) {
  begin_next_move();
}

Eigen::VectorXd MinimumJerkMoves::next_target() {
  Eigen::VectorXd target(to_.size());
  for (Eigen::Index k = 0; k < target.size(); ++k) {
    std::vector<std::size_t>& parts = parts_[static_cast<std::size_t>(k)];
    if (parts.empty()) {
      parts.resize(kParts);
      std::iota(parts.begin(), parts.end(), 0);
    }
    const std::size_t pick = random_.index(parts.size());
    target[k] = -1.0 + 2.0 * (static_cast<double>(parts[pick]) + random_.uniform()) / kParts;
    parts[pick] = parts.back();
    parts.pop_back();
  }
  return target;
}

void MinimumJerkMoves::begin_next_move() {
  begin_ += duration_ + rest_;
  from_ = to_;
  to_ = next_target();
  const double distance = (to_ - from_).lpNorm<Eigen::Infinity>();
  duration_ = (pace_.reaction + pace_.per_unit * distance) * random_.uniform(0.85, 1.15);
  rest_ = random_.uniform(0.0, pace_.longest_rest);
}

Eigen::VectorXd MinimumJerkMoves::at(double time) {
  while (time > begin_ + duration_ + rest_) {
    begin_next_move();
  }
  return from_ + minimum_jerk((time - begin_) / duration_) * (to_ - from_);
}

}  // namespace handway::device
