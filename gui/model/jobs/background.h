#pragma once

#include <QObject>
#include <QString>

#include <condition_variable>
#include <functional>
#include <future>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

namespace handway::gui {

/// A thread for one kind of question of which the latest alone counts: one that still waits when
/// another is asked is dropped. For the GUI thread's use.
class LatestJob : public QObject {
  Q_OBJECT

 public:
  /// Function that runs on the GUI thread with the results of a job; may be empty.
  using Answer = std::function<void()>;
  /// Runs on the job's thread. A stop is requested when the answer is not wanted any more.
  using Job = std::function<Answer(const std::stop_token& stop)>;

  explicit LatestJob(QObject* parent = nullptr);
  ~LatestJob() override;

  /// Cancels the previous job, whose answer never arrives, and runs this one.
  void run(Job job);
  /// Runs the job after the previous one has ended and its answer has arrived: for queries that may
  /// come faster than they can be answered.
  void run_next(Job job);
  /// Cancels the job, like run() without another job.
  void cancel();
  /// Returns whether an answer is still expected.
  [[nodiscard]] bool is_busy() const { return wanted_ != done_; }

 signals:
  /// The job threw that, and has no answer.
  void failed(const QString& message);
  /// An answer has arrived, or there is none to wait for any more.
  void ended();

 private:
  void drop();
  void work(const std::stop_token& stop);
  [[nodiscard]] Answer answer_of(const Job& job, const std::stop_token& cancelled);

  std::mutex mutex_;
  std::condition_variable_any wake_;
  Job next_;
  int next_ticket_ = 0;
  std::stop_source running_{std::nostopstate};
  int wanted_ = 0;  ///< GUI thread only, as are the rest.
  int done_ = 0;
  int dropped_ = 0;  ///< The last whose answer isn't wanted.
  std::jthread thread_;
};

/// Threads whose results are not waited for: each runs one job; the destructor waits for those that
/// still run. It is for use by one thread.
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

/// Runs a function on a thread of the global pool, without waiting for its end.
void run_in_background(std::function<void()> work);

}  // namespace handway::gui
