#include "core/motion_witness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace handway::device {
namespace {

constexpr double kLag = 0.3;        // s that a device may be late
constexpr double kWindow = 0.8;     // s of the motion that are looked at
constexpr double kMoves = 2e-3;     // rad or m: less is standing still
constexpr double kMissed = 0.04;    // rad or m that a joint may miss while it stands still
constexpr double kBack = 0.06;      // rad or m that a joint may run back
constexpr double kMonotone = 1e-6;  // rad or m
constexpr double kAhead = 1.0;      // s that it may run ahead from one message to the next

}  // namespace

void MotionWitness::begin(std::vector<std::string> names) {
  names_ = std::move(names);
  samples_.clear();
  rests_.clear();
}

std::optional<WitnessFault> MotionWitness::add(const JointTrajectory& motion, double time,
                                               const Eigen::VectorXd& position) {
  samples_.push_back({time, motion.at(time), position});
  while (samples_.front().time < time - kWindow) {
    samples_.pop_front();
  }
  if (auto fault = stand_still(motion, time, position)) {
    return fault;
  }
  return run_back();
}

std::optional<WitnessFault> MotionWitness::stand_still(const JointTrajectory& motion, double time,
                                                       const Eigen::VectorXd& position) {
  const Eigen::VectorXd late = motion.at(std::max(0.0, time - kLag));
  if (rests_.empty()) {
    rests_.resize(static_cast<std::size_t>(position.size()));
    for (std::size_t j = 0; j < rests_.size(); ++j) {
      const auto i = static_cast<Eigen::Index>(j);
      rests_[j] = {time, position[i], HUGE_VAL, -HUGE_VAL};
    }
  }
  for (std::size_t j = 0; j < rests_.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    Rest& rest = rests_[j];
    if (std::abs(position[i] - rest.position) > kMoves) {
      rest = {time, position[i], HUGE_VAL, -HUGE_VAL};
    }
    if (time - kLag < rest.time) {
      continue;
    }
    rest.least = std::min(rest.least, late[i]);
    rest.most = std::max(rest.most, late[i]);
    if (rest.most - rest.least > kMissed) {
      return WitnessFault{
          fmt::format("joint {} standing still at {:.4f} rad for {:.2f} s", names_[j], position[i],
                      time - rest.time),
          fmt::format("a motion of {:.4f} rad", rest.most - rest.least),
          "The device accepts the motion and does not run it: look at its controller."};
    }
  }
  return std::nullopt;
}

// Where the plan went one way for a while, the joint must not go the other way.
std::optional<WitnessFault> MotionWitness::run_back() const {
  if (samples_.size() < 2 || samples_.back().time - samples_.front().time < kWindow - kLag) {
    return std::nullopt;
  }
  for (Eigen::Index j = 0; j < samples_.back().measured.size(); ++j) {
    bool rises = true;
    bool falls = true;
    double drop = 0.0;
    double climb = 0.0;
    double most = -HUGE_VAL;
    double least = HUGE_VAL;
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      const Sample& sample = samples_[k];
      if (k > 0) {
        const double step = sample.planned[j] - samples_[k - 1].planned[j];
        rises = rises && step >= -kMonotone;
        falls = falls && step <= kMonotone;
      }
      if (sample.time < samples_.front().time + kLag) {
        continue;
      }
      most = std::max(most, sample.measured[j]);
      least = std::min(least, sample.measured[j]);
      drop = std::max(drop, most - sample.measured[j]);
      climb = std::max(climb, sample.measured[j] - least);
    }
    const bool stands = rises && falls;
    const bool is_back = stands ? drop > kBack && climb > kBack
                                : (rises && drop > kBack) || (falls && climb > kBack);
    if (is_back) {
      return WitnessFault{
          fmt::format("joint {} running back by {:.4f} rad", names_[static_cast<std::size_t>(j)],
                      rises && !stands   ? drop
                      : falls && !stands ? climb
                                         : std::min(drop, climb)),
          "a joint that follows the motion in order",
          "What the device reports is not the motion: look at its controller."};
    }
  }
  return std::nullopt;
}

std::optional<std::string> DeviceClock::note(double time, Clock::time_point received,
                                             double backward) {
  if (!std::isfinite(time)) {
    return "a time that is no number";
  }
  std::optional<std::string> fault;
  if (last_) {
    const double passed = std::chrono::duration<double>(received - last_->received).count();
    const double told = time - last_->time;
    if (told < -backward) {
      fault = fmt::format("a clock that ran back by {:.3g} s", -told);
    } else if (told - passed > kAhead) {
      fault = fmt::format("a clock that jumped ahead by {:.3g} s", told - passed);
    }
  }
  last_ = Tick{time, received};
  return fault;
}

}  // namespace handway::device
