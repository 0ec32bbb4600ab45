#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace handway::gui {

/// Listens for the keys that stop the robot on a connection of its own to the X server, on a thread
/// of its own: before any input method or dialog gets them, and however busy the window's thread
/// is. Pause (and Break) counts whichever program has the keyboard, Ctrl+Space and F12 while this
/// one has it.
class StopKeyListener {
 public:
  /// @param window any of this program's. @param stop called on the listener's thread for every
  /// press, and once if the connection is lost. It must not throw.
  StopKeyListener(std::uint32_t window, std::function<void()> stop);
  ~StopKeyListener();
  StopKeyListener(const StopKeyListener&) = delete;
  StopKeyListener& operator=(const StopKeyListener&) = delete;

 private:
  class Thread;
  std::unique_ptr<Thread> thread_;
};

}  // namespace handway::gui
