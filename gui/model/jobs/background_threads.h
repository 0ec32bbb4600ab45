#pragma once

#include <functional>
#include <future>
#include <thread>
#include <vector>

namespace handway::gui {

/// Threads that nobody waits for until the end: each runs one job; the
/// destructor waits for those that still do. For one thread's use.
class BackgroundThreads {
 public:
  /// @param job must not throw.
  void run(std::function<void()> job);

 private:
  struct Running {
    std::future<void> done;
    std::jthread thread;
  };
  std::vector<Running> running_;
};

}  // namespace handway::gui
