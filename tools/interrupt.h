#pragma once

#include <stop_token>

namespace handway::tools {

/// While it lives, Ctrl+C (or a request to terminate) asks for a stop instead of ending
/// the program; a second one ends it. One at a time.
class StopsOnInterrupt {
 public:
  /// @param stop must outlive it.
  explicit StopsOnInterrupt(std::stop_source& stop);
  ~StopsOnInterrupt();
  StopsOnInterrupt(const StopsOnInterrupt&) = delete;
  StopsOnInterrupt& operator=(const StopsOnInterrupt&) = delete;
};

}  // namespace handway::tools
