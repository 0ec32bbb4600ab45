#pragma once

#include <algorithm>
#include <chrono>

namespace handway::device {

/// The time of a device's samples: s since it was first connected, never going back.
class SampleClock {
 public:
  using Clock = std::chrono::steady_clock;

  /// Sets the zero; the second time, and later, without effect.
  void start() {
    if (!started_) {
      begin_ = Clock::now();
      started_ = true;
    }
  }

  [[nodiscard]] double seconds_at(Clock::time_point time) const {
    return std::chrono::duration<double>(time - begin_).count();
  }

  /// `time`, or that of the sample before if it is later.
  double not_before_last(double time) {
    last_ = std::max(last_, time);
    return last_;
  }

 private:
  bool started_ = false;
  double last_ = 0.0;
  Clock::time_point begin_;
};

}  // namespace handway::device
