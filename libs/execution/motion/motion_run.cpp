#include "handway/execution/motion/motion_run.h"

#include "handway/device/core/device_error.h"

#include <algorithm>

namespace handway::execution {
namespace {

using device::MotionPhase;
using Clock = device::MotionLink::Clock;

// How long devices may take to come to rest, s, and what is rest: positions from one time to the
// next, rad.
constexpr double kLongestRest = 1.5;
constexpr double kAtRest = 2e-4;
// From the wish to hold to the hold, s of the motion.
constexpr double kHoldNotice = 0.1;

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

class Run {
 public:
  Run(std::vector<MotionTarget>& targets, MotionObserver& observer)
      : targets_(targets), observer_(observer) {
    for (const MotionTarget& target : targets_) {
      const Eigen::Index joints = target.link->joints().count();
      outcome_.errors.emplace_back(joints);
      seen_.push_back(target.link->measured().samples);
      last_.push_back(target.link->measured().position);
      still_.push_back(0);
    }
  }

  MotionOutcome run(const device::MotionTolerances& tolerances, const MotionRequests& requests) {
    start(tolerances);
    auto polled = Clock::now();
    while (!requests.stop.stop_requested() && !ended()) {
      polled = Clock::now();
      hold(requests.hold);
      update();
      const device::MotionLink& first = *targets_.front().link;
      observer_.on_progress(first.motion_time(Clock::now()), outcome_.errors);
    }
    outcome_.done = outcome_.fault.empty() && !requests.stop.stop_requested();
    if (!outcome_.done) {
      for (const MotionTarget& target : targets_) {
        target.link->stop();
      }
      // The request came after `polled`.
      outcome_.stop_sent_ms = 1e3 * seconds(Clock::now() - polled);
    }
    wait_for_rest();
    return std::move(outcome_);
  }

 private:
  void start(const device::MotionTolerances& tolerances) {
    std::size_t started = 0;
    try {
      for (; started < targets_.size(); ++started) {
        targets_[started].link->start(tolerances);
      }
    } catch (const device::DeviceError&) {
      for (std::size_t i = 0; i < started; ++i) {
        targets_[i].link->stop();
      }
      throw;
    }
  }

  // With notice enough for all of them they hold at the same time of the motion.
  void hold(bool wanted) {
    if (wanted == held_) {
      return;
    }
    held_ = wanted;
    double time = targets_.front().link->motion_time(Clock::now()) + kHoldNotice;
    for (const MotionTarget& target : targets_) {
      if (wanted) {
        time = target.link->pause(time);
      } else {
        target.link->resume();
      }
    }
  }

  // Every device's news; errors count while it moves.
  void update() {
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      device::MotionLink& link = *targets_[i].link;
      const bool running = link.phase() == MotionPhase::kRunning;
      link.update();
      const device::MeasuredJoints& measured = link.measured();
      if (measured.samples == seen_[i]) {
        continue;
      }
      seen_[i] = measured.samples;
      const double time = link.motion_time(measured.received);
      const Eigen::VectorXd planned = link.trajectory().at(time);
      observer_.on_sample({time, i, planned, measured.position});
      if (running) {
        outcome_.time = std::min(time, link.trajectory().duration());
        outcome_.errors[i].add(measured.position - planned);
      }
      const bool still = (measured.position - last_[i]).cwiseAbs().maxCoeff() < kAtRest;
      still_[i] = still ? still_[i] + 1 : 0;
      last_[i] = measured.position;
    }
  }

  bool ended() {
    bool all_done = true;
    for (const MotionTarget& target : targets_) {
      if (target.link->phase() == MotionPhase::kFailed) {
        outcome_.fault = target.link->fault();
        return true;
      }
      all_done = all_done && target.link->phase() == MotionPhase::kDone;
    }
    return all_done;
  }

  void wait_for_rest() {
    const auto begin = Clock::now();
    still_.assign(still_.size(), 0);
    while (seconds(Clock::now() - begin) < kLongestRest) {
      update();
      if (std::ranges::all_of(still_, [](int times) { return times >= 2; })) {
        outcome_.at_rest_ms = 1e3 * seconds(Clock::now() - begin);
        return;
      }
    }
  }

  std::vector<MotionTarget>& targets_;
  MotionObserver& observer_;
  MotionOutcome outcome_;
  std::vector<std::uint64_t> seen_;
  std::vector<Eigen::VectorXd> last_;
  std::vector<int> still_;  ///< How many times in a row a device did not move.
  bool held_ = false;
};

}  // namespace

MotionOutcome run_motion(std::vector<MotionTarget>& targets,
                         const device::MotionTolerances& tolerances, const MotionRequests& requests,
                         MotionObserver& observer) {
  return Run(targets, observer).run(tolerances, requests);
}

}  // namespace handway::execution
