#pragma once

#include <array>
#include <chrono>
#include <csignal>
#include <thread>

namespace handway::gui {

class MotionDriver;

/// While it lives, the robot is stopped, and its rest is waited for, before the program ends
/// in ways that its window has no say in: by SIGINT, SIGTERM or SIGHUP, which then do what they
/// always do, and by exit(), as Qt and Xlib do when the display is lost. One at a time.
class ProgramEnd {
 public:
  /// Longest time to wait for rest.
  static constexpr std::chrono::milliseconds kLongestWait{2500};

  /// @param driver outlives it. @throws std::system_error if there is no pipe to be had.
  explicit ProgramEnd(MotionDriver& driver);
  ~ProgramEnd();
  ProgramEnd(const ProgramEnd&) = delete;
  ProgramEnd& operator=(const ProgramEnd&) = delete;

 private:
  static constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};

  void wait_for_signals();

  MotionDriver& driver_;
  std::array<int, 2> pipe_{};
  std::array<struct sigaction, kSignals.size()> before_{};
  std::thread thread_;
};

}  // namespace handway::gui
