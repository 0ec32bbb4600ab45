#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/extensions/plugin.h"

#include <condition_variable>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

namespace handway::gui {

/// A thread that prepares one thing at a time. Of the waiting jobs, the newest comes first; jobs
/// that are not wanted any more are not begun. It may be used by any thread.
class PreparationQueue {
 public:
  PreparationQueue();
  /// Stops what runs and what waits; waits for the former.
  ~PreparationQueue();
  PreparationQueue(const PreparationQueue&) = delete;
  PreparationQueue& operator=(const PreparationQueue&) = delete;

  /// @param wanted a stop is requested there once the outcome is not wanted any more; by the queue,
  /// too, at its end.
  /// @param job runs on the queue's thread, unless it isn't wanted by then; must not throw, and
  /// should end soon once it isn't wanted.
  void run(std::stop_source wanted, std::function<void()> job);

 private:
  struct Job {
    std::stop_source wanted;
    std::function<void()> work;
  };

  void work(const std::stop_token& end);

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::vector<Job> waiting_;
  std::stop_source running_{std::nostopstate};
  std::jthread thread_;
};

/// A scene's planning problem, built once, off the GUI thread (its collision checker takes
/// a while), for all collision queries. The preparation ends when the last owner releases
/// it.
class PreparedProblem {
 public:
  using Problem = std::shared_ptr<const planning::PlanningProblem>;

  /// The preparation begins at once. A scene without start or goal gets the robot's configuration
  /// for both.
  /// @param before that of the scene before an edit, which saves work; null for a scene that was
  /// just opened.
  PreparedProblem(planning::SceneState loaded, const planning::Revision& revision,
                  PreparationQueue& queue, const PreparedProblem* before = nullptr);
  ~PreparedProblem();
  PreparedProblem(const PreparedProblem&) = delete;
  PreparedProblem& operator=(const PreparedProblem&) = delete;

  /// Returns the revision of the scene, from which results of the problem are derived.
  [[nodiscard]] const planning::Revision& revision() const { return revision_; }

  /// Waits for the problem, at most until `stop` or the queue's end (null then).
  /// @throws InputError if the scene makes none.
  [[nodiscard]] Problem wait(const std::stop_token& stop) const;
  /// The problem if it is there by now and the scene makes one; else null.
  [[nodiscard]] Problem if_ready() const;

 private:
  /// @pre the preparation has ended.
  [[nodiscard]] Problem if_ended() const;

  planning::Revision revision_;
  std::stop_source wanted_;
  Problem known_;  ///< The last that was ready before this one; may be null.
  std::shared_future<Problem> problem_;
};

/// A collision checker for one thread at a time, made once its problem is there.
class OwnChecker {
 public:
  explicit OwnChecker(std::shared_ptr<const PreparedProblem> problem)
      : problem_(std::move(problem)) {}

  /// Returns the checker; null if PreparedProblem::wait() gives none. @throws InputError as that
  /// does.
  [[nodiscard]] geometric::CollisionChecker* wait(const std::stop_token& stop);

 private:
  std::shared_ptr<const PreparedProblem> problem_;
  std::unique_ptr<geometric::CollisionChecker> checker_;
};

}  // namespace handway::gui
