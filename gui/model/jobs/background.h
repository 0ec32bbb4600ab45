#pragma once

#include <QObject>
#include <QString>

#include <functional>
#include <memory>
#include <stop_token>
#include <vector>

namespace handway::gui {

/// Runs a function on a thread of the window's executor, without waiting for its end. The executor
/// is a pool that starts a thread where all others are at work, up to a limit that jobs do not
/// reach in practice: a long job does not delay a short one.
///
/// A job may wait for devices, files and PreparedProblem, but not for another job of the executor.
void run_in_background(std::function<void()> work);

/// A ticket on the executor for one kind of question of which the latest alone counts: one that
/// still waits when another is asked is dropped. Jobs of one ticket run one after the other; an
/// idle ticket has no thread. For the GUI thread's use.
class LatestJob : public QObject {
  Q_OBJECT

 public:
  /// Function that runs on the GUI thread with the results of a job; may be empty.
  using Answer = std::function<void()>;
  /// Runs on a thread of the executor. A stop is requested when the answer is not wanted any more.
  using Job = std::function<Answer(const std::stop_token& stop)>;

  explicit LatestJob(QObject* parent = nullptr);
  /// Cancels the job, and waits for the one that runs: jobs may refer to objects of the owner.
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
  struct Shared;

  void drop();
  /// Runs the jobs that wait, on a thread of the executor. @param shared outlives the ticket.
  /// @param ticket is used only while a job runs: it may be destroyed before the thread begins.
  static void work(LatestJob* ticket, Shared& shared);
  void take_answer(int number, const Answer& answer);
  [[nodiscard]] Answer answer_of(const Job& job, const std::stop_token& cancelled);

  std::shared_ptr<Shared> shared_;
  int wanted_ = 0;  ///< Number of the latest job.
  int done_ = 0;
  int dropped_ = 0;  ///< The last whose answer isn't wanted.
};

/// Jobs of the executor whose results are not waited for, any number at a time. The destructor
/// waits for those that run. For the GUI thread's use.
class BackgroundJobs {
 public:
  /// @param job must not throw.
  void run(const std::function<void()>& job);

 private:
  std::vector<std::unique_ptr<LatestJob>> tickets_;
};

}  // namespace handway::gui
