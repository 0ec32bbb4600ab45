#include "model/jobs/background.h"

#include <QThreadPool>

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <utility>

namespace handway::gui {
namespace {

// More than there are tickets and planners at a time, so that no job has to wait for a thread.
constexpr int kMostThreads = 256;

// Not Qt's global pool: Qt converts pictures there, while the GUI thread waits for them.
class Executor : public QThreadPool {
 public:
  Executor() { setMaxThreadCount(kMostThreads); }
};

}  // namespace

void run_in_background(std::function<void()> work) {
  static Executor executor;
  executor.start(std::move(work));
}

/// State that the ticket shares with the thread that runs its jobs.
struct LatestJob::Shared {
  std::mutex mutex;
  std::condition_variable idle;
  Job next;
  int next_number = 0;
  std::stop_source running{std::nostopstate};
  bool has_thread = false;  ///< Has one, or will get one.
  bool is_running = false;  ///< A job runs.
};

LatestJob::LatestJob(QObject* parent) : QObject(parent), shared_(std::make_shared<Shared>()) {}

LatestJob::~LatestJob() {
  drop();
  std::unique_lock lock(shared_->mutex);
  shared_->idle.wait(lock, [this] { return !shared_->is_running; });
}

// No answer that is still to come is wanted any more.
void LatestJob::drop() {
  dropped_ = wanted_;
  Job unwanted;  // released last, as that may take long
  const std::lock_guard lock(shared_->mutex);
  unwanted = std::exchange(shared_->next, nullptr);
  shared_->running.request_stop();
}

void LatestJob::run(Job job) {
  drop();
  run_next(std::move(job));
}

void LatestJob::run_next(Job job) {
  bool has_thread = false;
  {
    const std::lock_guard lock(shared_->mutex);
    shared_->next.swap(job);
    shared_->next_number = ++wanted_;
    has_thread = std::exchange(shared_->has_thread, true);
  }
  if (!has_thread) {
    run_in_background([ticket = this, shared = shared_] { work(ticket, *shared); });
  }
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

void LatestJob::take_answer(int number, const Answer& answer) {
  if (number <= dropped_) {
    return;
  }
  done_ = number;
  if (answer) {
    answer();
  }
  emit ended();
}

void LatestJob::work(LatestJob* ticket, Shared& shared) {
  std::unique_lock lock(shared.mutex);
  while (shared.next) {
    Job job = std::exchange(shared.next, nullptr);
    const int number = shared.next_number;
    shared.running = std::stop_source();
    const std::stop_token cancelled = shared.running.get_token();
    shared.is_running = true;
    lock.unlock();
    QMetaObject::invokeMethod(
        ticket,
        [ticket, number, answer = ticket->answer_of(job, cancelled)] {
          ticket->take_answer(number, answer);
        },
        Qt::QueuedConnection);
    job = nullptr;  // what it holds may be the owner's
    lock.lock();
    shared.is_running = false;
    shared.idle.notify_all();
  }
  shared.has_thread = false;
}

void BackgroundJobs::run(const std::function<void()>& job) {
  auto ticket = std::ranges::find_if_not(tickets_, &LatestJob::is_busy);
  if (ticket == tickets_.end()) {
    ticket = tickets_.insert(ticket, std::make_unique<LatestJob>());
  }
  (*ticket)->run_next([job](const std::stop_token&) -> LatestJob::Answer {
    job();
    return {};
  });
}

}  // namespace handway::gui
