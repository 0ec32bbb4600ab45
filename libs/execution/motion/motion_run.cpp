#include "handway/execution/motion/motion_run.h"

#include "handway/execution/motion/motion_target.h"
#include "target_tolerances.h"

#include <algorithm>
#include <exception>
#include <system_error>
#include <thread>

namespace handway::execution {

void FollowingError::add(const Eigen::VectorXd& error) {
  max_ = max_.cwiseMax(error.cwiseAbs());
  squares_ += error.cwiseAbs2();
  ++samples_;
}

void FollowingError::add(const FollowingError& other) {
  max_ = max_.cwiseMax(other.max_);
  squares_ += other.squares_;
  samples_ += other.samples_;
}

Eigen::VectorXd FollowingError::rms() const {
  return (squares_ / std::max(samples_, 1)).cwiseSqrt();
}

namespace {

using device::MotionPhase;
using Clock = device::TrajectoryClient::Clock;

// Longest wait for all devices to come to rest, s.
constexpr double kLongestRest = 1.5;
// Change of every joint from one sample to the next below which a device is at rest, rad.
constexpr double kAtRest = 2e-4;
// Motion time from the request of a hold to the hold, s.
constexpr double kHoldNotice = 0.1;

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

class Run {
 public:
  Run(std::vector<MotionTarget>& targets, const device::MotionTolerances& tolerances,
      MotionRequests& requests, MotionObserver& observer)
      : targets_(targets), requests_(requests), observer_(observer) {
    for (const MotionTarget& target : targets_) {
      tolerances_.push_back(tolerances_of(target, tolerances));
      const Eigen::Index joints = target.link->joints().count();
      outcome_.errors.emplace_back(joints);
      seen_.push_back(target.link->measured().samples);
      last_.push_back(target.link->measured().position);
      still_.push_back(0);
    }
  }

  MotionOutcome run() {
    if (!may_start()) {
      outcome_.at_rest_ms = 0.0;
      return std::move(outcome_);
    }
    outcome_.started = true;
    start();
    auto polled = Clock::now();
    while (!requests_.stop.stop_requested() && !ended()) {
      polled = Clock::now();
      guarded([&] {
        look_at_scene();
        hold_or_resume();
        update();
        report_progress();
      });
    }
    outcome_.done =
        outcome_.fault.empty() && outcome_.collision.empty() && !requests_.stop.stop_requested();
    if (!outcome_.done) {
      stop_all();
      // The stop was requested after `polled`.
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
  // Runs `step`. An exception of a device or of the observer is a fault that ends the motion of all
  // devices.
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

  // Stores the first fault. Later faults are its consequences and are ignored.
  void note_fault(const std::string& fault) {
    if (outcome_.fault.empty()) {
      outcome_.fault = fault.empty() ? "An exception without a message." : fault;
    }
  }

  void start() {
    try {
      for (std::size_t i = 0; i < targets_.size(); ++i) {
        targets_[i].link->start(tolerances_[i]);
      }
    } catch (...) {
      stop_all();
      wait_for_rest();
      throw;
    }
  }

  // Stops all devices in parallel: a device that accepts no more bytes delays only its own stop.
  void stop_all() {
    {
      std::vector<std::jthread> senders;
      for (const MotionTarget& target : targets_) {
        device::TrajectoryClient& link = *target.link;
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

  [[nodiscard]] double time() const { return targets_.front().link->motion_time(Clock::now()); }

  void ask_watch() {
    requests_.watch->ask(time(), with_measured(requests_.watch->start(), targets_));
  }
  [[nodiscard]] SceneVerdict verdict() const {
    return requests_.watch->look(time(), with_measured(requests_.watch->start(), targets_));
  }

  // Returns whether the motion may start: waits for the watch's verdict and polls the devices
  // meanwhile. Without a watch the motion may start at once.
  bool may_start() {
    if (requests_.stop.stop_requested() || !requests_.watch) {
      return !requests_.stop.stop_requested();
    }
    ask_watch();
    SceneVerdict start = verdict();
    while (start.state == SceneVerdict::State::kUnknown) {
      if (requests_.stop.stop_requested()) {
        return false;
      }
      for (const MotionTarget& target : targets_) {
        target.link->update();
      }
      start = verdict();
    }
    outcome_.collision = start.reason;
    return start.state == SceneVerdict::State::kFree;
  }

  // Pauses all devices with a notice, so that they can hold at the same motion time.
  void pause() {
    held_ = true;
    is_asked_ = false;
    const double now = time();
    hold_time_ = now + kHoldNotice;
    for (const MotionTarget& target : targets_) {
      hold_time_ = target.link->pause(hold_time_);
    }
    held_at_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                  std::chrono::duration<double>(hold_time_ - now));
  }

  void hold_or_resume() {
    if (requests_.hold) {
      is_asked_ = false;
      if (!held_) {
        pause();
      }
    } else if (held_ && rest_is_free()) {
      held_ = false;
      is_asked_ = false;
      for (const MotionTarget& target : targets_) {
        target.link->resume();
      }
    }
  }

  // Asks the watch once whether a held motion may continue, and returns whether its rest is known
  // to be free. If the rest is blocked the motion stays held.
  bool rest_is_free() {
    if (!requests_.watch) {
      return true;
    }
    if (!is_asked_) {
      is_asked_ = true;
      reason_.clear();
      ask_watch();
    }
    const SceneVerdict rest = verdict();
    if (rest.state == SceneVerdict::State::kBlocked) {
      is_asked_ = false;
      hold_for(rest.reason);
    }
    return rest.state == SceneVerdict::State::kFree;
  }

  // Sets MotionRequests::hold for a new reason and reports the reason. The motion then stays held
  // until the request is cleared from outside.
  void hold_for(const std::string& reason) {
    if (reason != reason_) {
      reason_ = reason;
      requests_.hold = true;
      if (observer_works_) {
        observe([&] { observer_.on_held(reason); });
      }
    }
  }

  // Holds or stops the motion if its rest or the measured configuration is blocked, or unchecked
  // for too long; reports if a held motion may continue.
  void look_at_scene() {
    if (!requests_.watch || is_asked_) {
      return;
    }
    const SceneVerdict now = verdict();
    if (now.state == SceneVerdict::State::kFree && held_ && !reason_.empty()) {
      hold_for("The scene changed; the remaining motion is free and can continue.");
    }
    if (now.state == SceneVerdict::State::kUnknown && !held_ &&
        Clock::now() - now.since >= SceneWatch::kLongestWait) {
      pause();
      hold_for(now.reason);
    }
    if (now.state == SceneVerdict::State::kBlocked) {
      if (!held_) {
        pause();
      }
      if (Clock::now() < held_at_ && now.time <= hold_time_) {
        outcome_.collision = now.reason;  // a hold would come too late
      } else {
        hold_for(now.reason);
      }
    }
  }

  // Polls all devices and reports new samples. Following errors are counted while a device runs.
  void update() {
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      device::TrajectoryClient& link = *targets_[i].link;
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
        outcome_.errors[i].add(tolerances_[i].distances(measured.position, planned));
      }
      const bool still = (measured.position - last_[i]).lpNorm<Eigen::Infinity>() < kAtRest;
      still_[i] = still ? still_[i] + 1 : 0;
      last_[i] = measured.position;
      if (observer_works_) {
        observe([&] { observer_.on_sample({time, i, planned, measured.position}); });
      }
    }
  }

  void report_progress() {
    if (observer_works_) {
      const device::TrajectoryClient& first = *targets_.front().link;
      observe([&] { observer_.on_progress(first.motion_time(Clock::now()), outcome_.errors); });
    }
  }

  // Calls the observer. After an exception it isn't called again, and the wait for rest goes on
  // without it.
  template <typename Call>
  void observe(const Call& call) {
    observer_works_ = false;
    call();
    observer_works_ = true;
  }

  bool ended() {
    if (!outcome_.fault.empty() || !outcome_.collision.empty()) {
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
  std::vector<device::MotionTolerances> tolerances_;  ///< By device.
  MotionRequests& requests_;
  MotionObserver& observer_;
  MotionOutcome outcome_;
  std::vector<std::uint64_t> seen_;
  std::vector<Eigen::VectorXd> last_;
  std::vector<int> still_;  ///< Number of consecutive samples at rest, by device.
  bool held_ = false;
  double hold_time_ = 0.0;      ///< Motion time of the hold, s.
  Clock::time_point held_at_;   ///< Clock time of the hold.
  bool is_asked_ = false;       ///< The watch was asked whether a held motion may continue.
  std::string reason_;          ///< Reason reported by hold_for(); empty: none yet.
  bool observer_works_ = true;  ///< The observer has thrown no exception.
};

}  // namespace

MotionOutcome run_motion(std::vector<MotionTarget>& targets,
                         const device::MotionTolerances& tolerances, MotionRequests& requests,
                         MotionObserver& observer) {
  return Run(targets, tolerances, requests, observer).run();
}

}  // namespace handway::execution
