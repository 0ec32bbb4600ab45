#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>

namespace handway::planning {

/// The threads of one run.
class ThreadPool {
 public:
  /// @param threads ≥ 1
  explicit ThreadPool(int threads) : arena_(threads), threads_(threads) {}

  [[nodiscard]] int size() const { return threads_; }

  /// Calls `work(i)` for `first` ≤ i < `last`, in any order on all threads; one after the other
  /// with a single thread or call.
  template <typename Work>
  void run(int first, int last, const Work& work) {
    if (threads_ > 1 && last - first > 1) {
      arena_.execute([&] { tbb::parallel_for(first, last, work, tbb::simple_partitioner()); });
      return;
    }
    for (int i = first; i < last; ++i) {
      work(i);
    }
  }

 private:
  tbb::task_arena arena_;
  int threads_;
};

/// The lowest of the indices that several threads offer.
class LowestIndex {
 public:
  /// @param none what it is until one is offered: more than any.
  explicit LowestIndex(int none) : lowest_(none) {}

  void offer(int index) {
    int known = lowest_.load();
    while (index < known && !lowest_.compare_exchange_weak(known, index)) {
    }
  }

  [[nodiscard]] int get() const { return lowest_.load(); }

 private:
  std::atomic<int> lowest_;
};

}  // namespace handway::planning
