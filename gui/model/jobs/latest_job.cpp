#include "model/jobs/latest_job.h"

#include <utility>

namespace handway::gui {

LatestJob::LatestJob(QObject* parent)
    : QObject(parent), thread_([this](const std::stop_token& stop) { work(stop); }) {}

LatestJob::~LatestJob() {
  thread_.request_stop();
  {
    const std::lock_guard lock(mutex_);
    running_.request_stop();
  }
  wake_.notify_all();
}

void LatestJob::run(Job job) {
  {
    const std::lock_guard lock(mutex_);
    next_ = std::move(job);
    next_ticket_ = ++wanted_;
    running_.request_stop();
  }
  wake_.notify_all();
}

void LatestJob::cancel() {
  {
    const std::lock_guard lock(mutex_);
    next_ = nullptr;
    running_.request_stop();
  }
  ++wanted_;
  done_ = wanted_;
  emit ended();
}

void LatestJob::work(const std::stop_token& stop) {
  while (true) {
    Job job;
    int ticket = 0;
    std::stop_token cancelled;
    {
      std::unique_lock lock(mutex_);
      if (!wake_.wait(lock, stop, [this] { return next_ != nullptr; })) {
        return;
      }
      job = std::exchange(next_, nullptr);
      ticket = next_ticket_;
      running_ = std::stop_source();
      cancelled = running_.get_token();
      if (stop.stop_requested()) {
        return;
      }
    }
    QMetaObject::invokeMethod(
        this,
        [this, ticket, answer = job(cancelled)] {
          if (ticket != wanted_) {
            return;
          }
          done_ = ticket;
          if (answer) {
            answer();
          }
          emit ended();
        },
        Qt::QueuedConnection);
  }
}

}  // namespace handway::gui
