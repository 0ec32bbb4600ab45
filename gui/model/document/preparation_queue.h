#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

namespace handway::gui {

/// A thread that prepares one thing at a time. Of those that wait, the newest comes first; what
/// nobody wants any more is not begun. For any thread's use.
class PreparationQueue {
 public:
  PreparationQueue();
  /// Stops what runs and what waits; waits for the former.
  ~PreparationQueue();
  PreparationQueue(const PreparationQueue&) = delete;
  PreparationQueue& operator=(const PreparationQueue&) = delete;

  /// @param wanted a stop is requested there once nobody wants the outcome; by the queue, too, at
  /// its end.
  /// @param job runs on the queue's thread, unless it isn't wanted by then; must not throw, and
  /// should end soon once it isn't wanted.
  void run(std::stop_source wanted, std::function<void()> job);

 private:
  struct Job {
    std::stop_source wanted;
    std::function<void()> work;
  };

  void work(const std::stop_token& end);

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::vector<Job> waiting_;
  std::stop_source running_{std::nostopstate};
  std::jthread thread_;
};

}  // namespace handway::gui
