#include "model/document/preparation_queue.h"

#include <utility>

namespace handway::gui {

PreparationQueue::PreparationQueue() : thread_([this](const std::stop_token& end) { work(end); }) {}

PreparationQueue::~PreparationQueue() {
  thread_.request_stop();
  const std::lock_guard lock(mutex_);
  running_.request_stop();
  for (Job& job : waiting_) {
    job.wanted.request_stop();
  }
}

void PreparationQueue::run(std::stop_source wanted, std::function<void()> job) {
  {
    const std::lock_guard lock(mutex_);
    std::erase_if(waiting_, [](const Job& other) { return other.wanted.stop_requested(); });
    waiting_.push_back({std::move(wanted), std::move(job)});
  }
  wake_.notify_one();
}

void PreparationQueue::work(const std::stop_token& end) {
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, end, [this] { return !waiting_.empty(); }) && !end.stop_requested()) {
    Job job = std::move(waiting_.back());
    waiting_.pop_back();
    if (job.wanted.stop_requested()) {
      continue;
    }
    running_ = job.wanted;
    lock.unlock();
    job.work();
    job.work = nullptr;  // what it holds may take long to release
    lock.lock();
  }
}

}  // namespace handway::gui
