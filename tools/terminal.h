#pragma once

#include <array>
#include <csignal>
#include <stop_token>
#include <string>

namespace handway::tools {

/// Prints a table of whole lines on a terminal, over the one of as many lines printed before
/// unless it is the first.
void print_table(const std::string& table, bool first);

/// Prints a line at once, also where standard output is a file.
void print_line(const std::string& line);

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
