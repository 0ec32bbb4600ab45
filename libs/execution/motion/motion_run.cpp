#include "handway/execution/motion/motion_run.h"

#include <algorithm>
#include <exception>
#include <system_error>
#include <thread>

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
    if (requests.stop.stop_requested()) {
      outcome_.at_rest_ms = 0.0;
      return std::move(outcome_);
    }
    start(tolerances);
    auto polled = Clock::now();
    while (!requests.stop.stop_requested() && !ended()) {
      polled = Clock::now();
      guarded([&] {
        hold(requests.hold);
        update();
        report_progress();
      });
    }
    outcome_.done = outcome_.fault.empty() && !requests.stop.stop_requested();
    if (!outcome_.done) {
      stop_all();
      // The request came after `polled`.
      outcome_.stop_sent = Clock::now();
      outcome_.stop_sent_ms = 1e3 * seconds(outcome_.stop_sent - polled);
    }
    wait_for_rest();
    if (outcome_.done && !outcome_.fault.empty()) {
      outcome_.done = false;
      stop_all();
    }
    return std::move(outcome_);
  }

 private:
  // What one device or the observer throws is the fault that ends the motion of all.
  template <typename Step>
  void guarded(const Step& step) {
    try {
      step();
    } catch (const std::exception& error) {
      note_fault(error.what());
    } catch (...) {
      note_fault("An unknown exception.");
    }
  }

  // The first counts: what follows is its consequence.
  void note_fault(const std::string& fault) {
    if (outcome_.fault.empty()) {
      outcome_.fault = fault.empty() ? "An exception without a message." : fault;
    }
  }

  void start(const device::MotionTolerances& tolerances) {
    try {
      for (const MotionTarget& target : targets_) {
        target.link->start(tolerances);
      }
    } catch (...) {
      stop_all();
      wait_for_rest();
      throw;
    }
  }

  // All at the same time: a device that takes no more bytes holds up its own stop only.
  void stop_all() {
    {
      std::vector<std::jthread> senders;
      for (const MotionTarget& target : targets_) {
        device::MotionLink& link = *target.link;
        try {
          senders.emplace_back([&link] { link.stop(); });
        } catch (const std::system_error&) {
          link.stop();
        }
      }
    }
    for (const MotionTarget& target : targets_) {
      if (target.link->phase() == MotionPhase::kFailed) {
        note_fault(target.link->fault());
      }
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
      if (running) {
        outcome_.time = std::min(time, link.trajectory().duration());
        outcome_.errors[i].add(measured.position - planned);
      }
      const bool still = (measured.position - last_[i]).cwiseAbs().maxCoeff() < kAtRest;
      still_[i] = still ? still_[i] + 1 : 0;
      last_[i] = measured.position;
      if (observer_works_) {
        observe([&] { observer_.on_sample({time, i, planned, measured.position}); });
      }
    }
  }

  void report_progress() {
    if (observer_works_) {
      const device::MotionLink& first = *targets_.front().link;
      observe([&] { observer_.on_progress(first.motion_time(Clock::now()), outcome_.errors); });
    }
  }

  // An observer that threw isn't called again: rest has to be waited for without it.
  template <typename Call>
  void observe(const Call& call) {
    observer_works_ = false;
    call();
    observer_works_ = true;
  }

  bool ended() {
    if (!outcome_.fault.empty()) {
      return true;
    }
    bool all_done = true;
    for (const MotionTarget& target : targets_) {
      if (target.link->phase() == MotionPhase::kFailed) {
        note_fault(target.link->fault());
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
      guarded([this] { update(); });
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
  bool observer_works_ = true;  ///< It has thrown nothing.
};

}  // namespace

MotionOutcome run_motion(std::vector<MotionTarget>& targets,
                         const device::MotionTolerances& tolerances, const MotionRequests& requests,
                         MotionObserver& observer) {
  return Run(targets, observer).run(tolerances, requests);
}

}  // namespace handway::execution
