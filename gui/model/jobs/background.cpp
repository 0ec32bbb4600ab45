#include "model/jobs/background.h"

#include <QRunnable>
#include <QThreadPool>

#include <chrono>
#include <exception>
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

// No answer that is still to come is wanted any more.
void LatestJob::drop() {
  dropped_ = wanted_;
  const std::lock_guard lock(mutex_);
  next_ = nullptr;
  running_.request_stop();
}

void LatestJob::run(Job job) {
  drop();
  run_next(std::move(job));
}

void LatestJob::run_next(Job job) {
  {
    const std::lock_guard lock(mutex_);
    next_ = std::move(job);
    next_ticket_ = ++wanted_;
  }
  wake_.notify_all();
}

void LatestJob::cancel() {
  drop();
  done_ = wanted_;
  emit ended();
}

LatestJob::Answer LatestJob::answer_of(const Job& job, const std::stop_token& cancelled) {
  try {
    return job(cancelled);
  } catch (const std::exception& error) {
    return [this, message = QString::fromUtf8(error.what())] { emit failed(message); };
  }
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
        [this, ticket, answer = answer_of(job, cancelled)] {
          if (ticket <= dropped_) {
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

void BackgroundThreads::run(std::function<void()> job) {
  std::erase_if(running_, [](const Running& running) {
    return running.done.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  });
  std::packaged_task<void()> task(std::move(job));
  std::future<void> done = task.get_future();
  running_.push_back({std::move(done), std::jthread(std::move(task))});
}

namespace {

class Task : public QRunnable {
 public:
  explicit Task(std::function<void()> work) : work_(std::move(work)) {}
  void run() override { work_(); }

 private:
  std::function<void()> work_;
};

}  // namespace

void run_in_background(std::function<void()> work) {
  QThreadPool::globalInstance()->start(new Task(std::move(work)));
}

}  // namespace handway::gui
