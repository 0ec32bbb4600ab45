#pragma once

#include <functional>
#include <memory>

namespace handway::gui {

/// Listens for Pause (and Break) on a connection of its own to the X server, on a thread of its
/// own: whichever program has the keyboard, whatever grabs it, and however busy the window's thread
/// is.
class StopKeyListener {
 public:
  /// @param stop called on the listener's thread for every press, and once if the connection is
  /// lost. It must not throw.
  explicit StopKeyListener(std::function<void()> stop);
  ~StopKeyListener();
  StopKeyListener(const StopKeyListener&) = delete;
  StopKeyListener& operator=(const StopKeyListener&) = delete;

  /// False where there is no X server with the X Input extension 2.1, as under Wayland.
  [[nodiscard]] bool is_listening() const { return thread_ != nullptr; }

 private:
  class Thread;
  std::unique_ptr<Thread> thread_;
};

}  // namespace handway::gui
