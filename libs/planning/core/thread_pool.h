#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace handway::planning {

/// The threads of one run.
class ThreadPool {
 public:
  /// @param threads ≥ 1
  explicit ThreadPool(int threads) : arena_(threads), threads_(threads) {}

  [[nodiscard]] int size() const { return threads_; }

  /// Calls `work(i)` for `first` ≤ i < `last`, in any order on all threads; one after the other
  /// where there is one thread, or one call.
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

}  // namespace handway::planning
