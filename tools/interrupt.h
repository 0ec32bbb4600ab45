#pragma once

#include <array>
#include <csignal>
#include <stop_token>

namespace handway::tools {

/// While it lives, Ctrl+C, a request to terminate and a terminal that is closed ask for a stop
/// instead of ending the program; a second one ends it. One at a time.
class StopsOnInterrupt {
 public:
  /// @param stop must outlive it.
  explicit StopsOnInterrupt(std::stop_source& stop);
  ~StopsOnInterrupt();
  StopsOnInterrupt(const StopsOnInterrupt&) = delete;
  StopsOnInterrupt& operator=(const StopsOnInterrupt&) = delete;

 private:
  static constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};
  std::array<void (*)(int), kSignals.size()> before_{};
};

}  // namespace handway::tools
