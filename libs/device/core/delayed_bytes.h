#pragma once

#include "host_port.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

namespace handway::device {

/// What an emulated device sends, kept until its time has come; order is kept too.
class DelayedBytes {
 public:
  /// @param due s, by the clock of send().
  void add(std::vector<std::uint8_t> bytes, double due) {
    waiting_.emplace_back(due, std::move(bytes));
  }
  void clear() { waiting_.clear(); }

  /// When send() has something to do again, s; nothing if nothing waits.
  [[nodiscard]] std::optional<double> next_due() const {
    return waiting_.empty() ? std::nullopt : std::optional(waiting_.front().first);
  }

  void send(HostPort& port, double now) {
    while (!waiting_.empty() && waiting_.front().first <= now) {
      port.write(waiting_.front().second);
      waiting_.pop_front();
    }
  }

 private:
  std::deque<std::pair<double, std::vector<std::uint8_t>>> waiting_;
};

}  // namespace handway::device
