#pragma once

#include <chrono>

namespace handway::planning {

/// Adds the time from construction to stop(), or to destruction, to a sum of seconds.
class PhaseClock {
 public:
  explicit PhaseClock(double& sum) : sum_(sum), begin_(Clock::now()) {}
  ~PhaseClock() { stop(); }
  PhaseClock(const PhaseClock&) = delete;
  PhaseClock& operator=(const PhaseClock&) = delete;

  void stop() {
    if (running_) {
      sum_ += std::chrono::duration<double>(Clock::now() - begin_).count();
      running_ = false;
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  double& sum_;
  Clock::time_point begin_;
  bool running_ = true;
};

}  // namespace handway::planning
