#pragma once

#include <chrono>
#include <optional>

namespace handway::device {

/// For how long a device has been sending more than was read, so that what was read is old.
class Backlog {
 public:
  using Clock = std::chrono::steady_clock;

  /// A turn of reading is over. @param all whether it took everything that had come.
  void turn(bool all, Clock::time_point now) {
    if (all) {
      since_.reset();
    } else if (!since_) {
      since_ = now;
    }
  }

  [[nodiscard]] bool any() const { return since_.has_value(); }
  /// Zero if there is none.
  [[nodiscard]] Clock::duration lasted(Clock::time_point now) const {
    return since_ ? now - *since_ : Clock::duration::zero();
  }

 private:
  std::optional<Clock::time_point> since_;
};

}  // namespace handway::device
