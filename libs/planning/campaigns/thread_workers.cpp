#include "handway/planning/campaigns/run_workers.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace handway::planning {
namespace {

/// Records that go from the threads to the one that takes them.
class RecordQueue {
 public:
  explicit RecordQueue(int workers) : busy_(workers) {}

  void push(RunRecord record) {
    const std::lock_guard lock(mutex_);
    records_.push_back(std::move(record));
    changed_.notify_one();
  }
  void worker_done(std::exception_ptr failure) {
    const std::lock_guard lock(mutex_);
    if (!failure_) {
      failure_ = std::move(failure);
    }
    --busy_;
    changed_.notify_one();
  }

  struct Batch {
    std::vector<RunRecord> records;
    bool last = false;           ///< No worker is busy any more.
    std::exception_ptr failure;  ///< Why the first that failed did.
  };
  /// Waits for records, but not longer than a moment.
  Batch pop() {
    constexpr std::chrono::milliseconds kMoment(200);
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, kMoment, [&] { return !records_.empty() || busy_ == 0; });
    return {std::exchange(records_, {}), busy_ == 0, failure_};
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<RunRecord> records_;
  std::exception_ptr failure_;
  int busy_;
};

}  // namespace

void ThreadWorkers::carry_out(const RunExecutor& executor, std::span<const RunSpec> runs,
                              const TakeRecords& take, std::stop_token stop) {
  const int workers =
      static_cast<int>(std::clamp<std::size_t>(runs.size(), 1, static_cast<std::size_t>(count_)));
  RecordQueue queue(workers);
  std::stop_source all;
  const std::stop_callback forward(stop, [&] { all.request_stop(); });
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    std::exception_ptr failure;
    try {
      for (std::size_t i = next++; i < runs.size() && !all.stop_requested(); i = next++) {
        if (std::optional<RunRecord> record = executor.run(runs[i], all.get_token())) {
          queue.push(std::move(*record));
        }
      }
    } catch (...) {
      failure = std::current_exception();
      all.request_stop();
    }
    queue.worker_done(failure);
  };
  std::vector<std::jthread> threads;
  try {
    for (int i = 0; i < workers; ++i) {
      threads.emplace_back(work);
    }
    for (bool last = false; !last;) {
      const RecordQueue::Batch batch = queue.pop();
      take(batch.records);
      last = batch.last;
      if (last && batch.failure) {
        std::rethrow_exception(batch.failure);
      }
    }
  } catch (...) {
    all.request_stop();
    throw;  // the threads are joined first
  }
}

}  // namespace handway::planning
