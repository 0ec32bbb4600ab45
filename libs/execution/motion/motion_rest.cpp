#include "motion_rest.h"

#include "target_tolerances.h"

#include <fmt/format.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <utility>

namespace handway::execution {
namespace {

using Clock = std::chrono::steady_clock;

class Rest {
 public:
  Rest(std::vector<MotionTarget>& targets, const MotionPart& part,
       const device::MotionTolerances& tolerances, MotionRequests& requests,
       MotionObserver& observer)
      : targets_(targets),
        q_(part.trajectory.points.back().position),
        duration_(part.trajectory.duration()),
        requests_(requests),
        observer_(observer) {
    device::MotionTolerances of_part = tolerances;
    of_part.give = part.give;
    for (const MotionTarget& target : targets_) {
      tolerances_.push_back(tolerances_of(target, of_part));
      outcome_.errors.emplace_back(target.link->joints().count());
      seen_.push_back(target.link->measured().samples);
    }
  }

  MotionOutcome run() {
    try {
      if (requests_.watch) {
        requests_.watch->ask(0.0, with_measured(requests_.watch->start(), targets_));
      }
      rest();
    } catch (const std::exception& error) {
      outcome_.fault = error.what();
    }
    outcome_.done = outcome_.fault.empty() && !requests_.stop.stop_requested();
    outcome_.started = outcome_.done || !outcome_.fault.empty();
    outcome_.at_rest_ms = 0.0;
    if (!outcome_.done) {
      outcome_.stop_sent = Clock::now();
      for (const MotionTarget& target : targets_) {
        target.link->stop();
      }
    }
    return std::move(outcome_);
  }

 private:
  void rest() {
    auto last = Clock::now();
    while (outcome_.time < duration_ && outcome_.fault.empty() &&
           !requests_.stop.stop_requested()) {
      hold_if_blocked();
      update();
      const auto now = Clock::now();
      if (!requests_.hold) {
        outcome_.time += std::chrono::duration<double>(now - last).count();
      }
      last = now;
      observer_.on_progress(outcome_.time, outcome_.errors);
    }
  }

  void hold_if_blocked() {
    if (!requests_.watch) {
      return;
    }
    const SceneVerdict verdict =
        requests_.watch->look(outcome_.time, with_measured(requests_.watch->start(), targets_));
    if (verdict.state != SceneVerdict::State::kBlocked) {
      reason_.clear();
      return;
    }
    requests_.hold = true;
    if (std::exchange(reason_, verdict.reason) != verdict.reason) {
      observer_.on_held(verdict.reason);
    }
  }

  void update() {
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      device::TrajectoryClient& link = *targets_[i].link;
      link.update();
      if (!link.fault().empty()) {
        outcome_.fault = link.fault();
        return;
      }
      const device::MeasuredJoints& measured = link.measured();
      if (std::exchange(seen_[i], measured.samples) != measured.samples) {
        take_sample(i, measured.position);
      }
    }
  }

  void take_sample(std::size_t target, const Eigen::VectorXd& measured) {
    const Eigen::VectorXd planned = q_(targets_[target].variables);
    const Eigen::VectorXd errors = tolerances_[target].distances(measured, planned);
    outcome_.errors[target].add(errors);
    observer_.on_sample({outcome_.time, target, planned, measured});
    Eigen::Index joint = 0;
    if (errors.size() > 0 && errors.maxCoeff(&joint) > tolerances_[target].following) {
      const device::TrajectoryClient& link = *targets_[target].link;
      outcome_.fault =
          fmt::format("{}: joint {} is {:.4f} rad from where it has to wait.", link.name(),
                      link.joints().names[static_cast<std::size_t>(joint)], errors[joint]);
    }
  }

  std::vector<MotionTarget>& targets_;
  const geometric::Configuration& q_;
  double duration_;
  std::vector<device::MotionTolerances> tolerances_;  ///< By device.
  MotionRequests& requests_;
  MotionObserver& observer_;
  MotionOutcome outcome_;
  std::vector<std::uint64_t> seen_;  ///< Numbers of samples, by device.
  std::string reason_;               ///< Reason of the hold that was reported last.
};

}  // namespace

MotionOutcome run_rest(std::vector<MotionTarget>& targets, const MotionPart& part,
                       const device::MotionTolerances& tolerances, MotionRequests& requests,
                       MotionObserver& observer) {
  return Rest(targets, part, tolerances, requests, observer).run();
}

}  // namespace handway::execution
