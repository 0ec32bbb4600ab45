#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace handway::tools {

/// Calls `work` with each of 0, …, count - 1, one call at a time on each core.
/// @throws the first exception of `work`, after which no further call begins.
template <typename Work>
void on_all_cores(std::size_t count, const Work& work) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr failure;
  std::mutex mutex;  // of `failure`
  {
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i) {
      threads.emplace_back([&] {
        try {
          for (std::size_t k = next++; k < count; k = next++) {
            work(k);
          }
        } catch (...) {
          next = count;
          const std::lock_guard lock(mutex);
          failure = failure ? failure : std::current_exception();
        }
      });
    }
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
}

}  // namespace handway::tools
