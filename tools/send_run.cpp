#include "send_run.h"

#include "handway/device/core/device_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace handway::tools {
namespace {

using device::MotionPhase;
using Clock = device::MotionLink::Clock;

constexpr double kProgressPeriod = 0.5;  // s
// How long devices may take to come to rest, s, and what is rest: positions from one time to the
// next, rad.
constexpr double kLongestRest = 1.5;
constexpr double kAtRest = 2e-4;

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

class Run {
 public:
  Run(std::vector<SendTarget>& targets, MotionLog& log) : targets_(targets), log_(log) {
    for (const SendTarget& target : targets_) {
      const Eigen::Index joints = target.link->joints().count();
      outcome_.errors.emplace_back(joints);
      seen_.push_back(target.link->measured().samples);
      last_.push_back(target.link->measured().position);
      still_.push_back(0);
    }
  }

  SendOutcome run(const device::MotionTolerances& tolerances, const std::stop_token& stop) {
    start(tolerances);
    auto polled = Clock::now();
    while (!stop.stop_requested() && !ended()) {
      polled = Clock::now();
      update();
      show_progress();
    }
    outcome_.done = outcome_.fault.empty() && !stop.stop_requested();
    if (!outcome_.done) {
      for (const SendTarget& target : targets_) {
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

  // Every device's news, to the log; errors count while it moves.
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
      log_.add(time, i, planned, measured.position);
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
    for (const SendTarget& target : targets_) {
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

  void show_progress() {
    const device::MotionLink& link = *targets_.front().link;
    const double time = link.motion_time(Clock::now());
    if (time < next_progress_) {
      return;
    }
    next_progress_ += kProgressPeriod;
    std::string line = fmt::format("{:.1f} of {:.1f} s", time, link.trajectory().duration());
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      line += fmt::format(", {} up to {:.4f} rad off", targets_[i].kind,
                          outcome_.errors[i].max().maxCoeff());
    }
    fmt::print("{}\n", line);
    std::fflush(stdout);
  }

  std::vector<SendTarget>& targets_;
  MotionLog& log_;
  SendOutcome outcome_;
  std::vector<std::uint64_t> seen_;
  std::vector<Eigen::VectorXd> last_;
  std::vector<int> still_;  ///< How many times in a row a device did not move.
  double next_progress_ = kProgressPeriod;
};

}  // namespace

SendOutcome run_motion(std::vector<SendTarget>& targets, const device::MotionTolerances& tolerances,
                       MotionLog& log, const std::stop_token& stop) {
  return Run(targets, log).run(tolerances, stop);
}

}  // namespace handway::tools
