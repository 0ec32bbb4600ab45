#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

namespace handway::device {

/// Duration for which a device has been sending more than was read, so that the data are old.
class Backlog {
 public:
  using Clock = std::chrono::steady_clock;

  /// Records the end of a turn of reading. @param all whether everything pending was read.
  void turn(bool all, Clock::time_point now) {
    if (all) {
      since_.reset();
    } else if (!since_) {
      since_ = now;
    }
  }

  [[nodiscard]] bool any() const { return since_.has_value(); }
  /// Duration of the backlog; zero without one.
  [[nodiscard]] Clock::duration lasted(Clock::time_point now) const {
    return since_ ? now - *since_ : Clock::duration::zero();
  }

 private:
  std::optional<Clock::time_point> since_;
};

/// Time for which a device has reported nothing while the program was listening. Time in which the
/// program itself was delayed, by a busy or sleeping computer, does not count.
class Watchdog {
 public:
  using Clock = std::chrono::steady_clock;

  /// Records a message, or that one is expected now.
  void heard(Clock::time_point now) {
    listened_ = now;
    lasted_ = Clock::duration::zero();
  }

  /// Records that reading gave nothing. @returns how long that has been so.
  Clock::duration listened(Clock::time_point now) {
    lasted_ += std::min<Clock::duration>(now - listened_, kLongestPause);
    listened_ = now;
    return lasted_;
  }

 private:
  /// Longest time between two reads; a longer one is a delay of the program.
  static constexpr std::chrono::milliseconds kLongestPause{20};

  Clock::time_point listened_ = Clock::now();
  Clock::duration lasted_ = Clock::duration::zero();
};

}  // namespace handway::device
