#pragma once

#include <array>
#include <csignal>
#include <stop_token>
#include <string>

namespace handway::tools {

/// Prints a table of whole lines on a terminal, replacing the previous table of as many lines
/// unless it is the first.
void print_table(const std::string& table, bool first);

/// Prints a line at once, also if standard output is a file.
void print_line(const std::string& line);

/// During its lifetime, Ctrl+C, a request to terminate and a closed terminal request a stop instead
/// of ending the program; a second one ends it. One at a time.
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
