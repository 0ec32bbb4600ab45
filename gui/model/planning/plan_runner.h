#pragma once

#include "handway/planning/core/objective.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/timing/time_path.h"
#include "handway/sampling/postures/posture_table.h"
#include "model/document/prepared_problem.h"
#include "model/jobs/background.h"
#include "model/planning/palm_roadmap.h"
#include "model/playback/motion_analysis.h"

#include <QObject>
#include <QString>

#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

namespace handway::gui {

/// Runs a planner in the background and reports its progress to the GUI thread.
class PlanRunner : public QObject {
  Q_OBJECT

 public:
  explicit PlanRunner(QObject* parent = nullptr);
  ~PlanRunner() override;

  /// Plans the problem's own query.
  /// @param palm_link whose place is reported for every node.
  /// @pre no run is going on; the planner is not touched until it has ended.
  void start(std::shared_ptr<planning::Planner> planner,
             std::shared_ptr<const PreparedProblem> problem, const planning::PlanRequest& request,
             int palm_link);
  /// Requests the end of the run, which ends within 100 ms.
  void cancel();
  [[nodiscard]] bool is_running() const { return job_.is_busy(); }

 signals:
  /// @param fraction in [0, 1].
  void progressed(double fraction, const QString& activity);
  /// All that has been found by now.
  void roadmap_found(const handway::gui::SharedRoadmap& roadmap);
  void finished(const handway::planning::PlanResult& result);
  /// @param message one sentence for a person.
  void failed(const QString& message);

 private:
  class Reporter;

  std::stop_source stop_{std::nostopstate};
  LatestJob job_;
};

/// One plan with several seeds.
struct SeedRuns {
  std::shared_ptr<const PreparedProblem> problem;
  /// Equal planners, one for each simultaneous run.
  std::vector<std::shared_ptr<planning::Planner>> planners;
  planning::PlanRequest request;  ///< For the first seed; each has the next, and one thread.
  int count = 1;
  std::shared_ptr<const sampling::RecordedPostures> postures;  ///< May be null.
};

/// Outcome of one of these seeds.
struct SeedOutcome {
  planning::PlanRequest request;
  planning::PlanResult result;
  std::shared_ptr<const planning::Motion> motion;  ///< Null: no path, or none that can be timed.
  std::shared_ptr<const MotionCurves> curves;      ///< hand_curves(); null as the motion is.
};

/// Plans with several seeds, several at a time, in the background, and times what is found.
class SeedRunner : public QObject {
  Q_OBJECT

 public:
  explicit SeedRunner(QObject* parent = nullptr) : QObject(parent) {}
  ~SeedRunner() override;

  /// @pre none are going on; the planners are not touched until they have ended.
  void start(SeedRuns runs);
  /// Ends the runs at once; later results are not reported.
  void cancel();
  [[nodiscard]] bool is_running() const { return running_; }

 signals:
  /// Emitted for each seed, in the order in which they are done.
  void found(const handway::gui::SeedOutcome& outcome);
  /// All are done, or were cancelled.
  void ended(bool cancelled);
  /// Emitted if the seeds can't be run. @param message one displayed sentence.
  void failed(const QString& message);

 private:
  struct Shared;

  void work(const std::shared_ptr<Shared>& shared,
            const std::shared_ptr<planning::Planner>& planner, int generation);
  void take(int generation, const SeedOutcome& outcome);
  void take_failure(int generation, const QString& message);

  bool running_ = false;
  int generation_ = 0;
  int to_come_ = 0;
  std::stop_source stop_{std::nostopstate};
  BackgroundJobs jobs_;
};

/// A path that is to be optimised further.
struct OptimizeTask {
  std::shared_ptr<const PreparedProblem> problem;
  planning::ObjectiveSettings objective;
  planning::PlanResult found;     ///< The path, and what is known of it.
  planning::PlanRequest request;  ///< Its seed, and for how long at most: optimize_s.
};

/// Progress of optimising.
struct OptimizeProgress {
  planning::Path path;                  ///< The best so far.
  double seconds = 0.0;                 ///< Time of this run.
  double limit_s = 0.0;                 ///< It ends after these at the latest; may be infinite.
  double cost_before = 0.0;             ///< When it first began.
  double cost = 0.0;                    ///< Cost of the present path.
  double length = 0.0;                  ///< In joints normalised to [0, 1].
  std::optional<double> hand_distance;  ///< Mean, from the PMD subspace; nothing: no basis.
  bool converged = false;
};

/// Outcome of optimising.
struct OptimizeOutcome {
  planning::PlanResult result;
  OptimizeProgress last;
  /// The path that it began with had not been optimised after smoothing: the result's
  /// optimize_checks repeat all of it.
  bool repeatable = false;
};

/// Optimises a path in the background, and reports how the path gets better.
///
/// The path is that of a number of whole rounds, as `handway plan --optimize` makes them. A run
/// that takes up the path that the last one left goes on where that ended.
class OptimizeRunner : public QObject {
  Q_OBJECT

 public:
  explicit OptimizeRunner(QObject* parent = nullptr);
  ~OptimizeRunner() override;

  /// @pre none is going on.
  void start(OptimizeTask task);
  /// Stops optimising after the present round; the best path so far is the outcome.
  void stop();
  /// Stops optimising without an outcome.
  void discard();
  [[nodiscard]] bool is_running() const { return job_.is_busy(); }

 signals:
  /// Several times a second.
  void progressed(const handway::gui::OptimizeProgress& progress);
  void finished(const handway::gui::OptimizeOutcome& outcome);
  /// @param message one sentence for a person.
  void failed(const QString& message);

 private:
  struct Work;

  /// Part of the job.
  void take_up(const OptimizeTask& task, const PreparedProblem::Problem& problem);
  [[nodiscard]] OptimizeProgress progress(double seconds, double limit_s) const;
  [[nodiscard]] OptimizeOutcome run(const OptimizeTask& task, int generation,
                                    const std::stop_token& stop, const std::stop_token& discarded);

  std::unique_ptr<Work> work_;  ///< For the job alone.
  std::stop_source stop_;
  int generation_ = 0;
  LatestJob job_;
};

/// A motion, and the revision that it was timed and checked in.
using DerivedMotion = planning::Derived<std::shared_ptr<const planning::TimedPath>>;

/// Makes motions of paths off the GUI thread. Only the answer to the latest request counts.
class TimingRunner : public QObject {
  Q_OBJECT

 public:
  explicit TimingRunner(QObject* parent = nullptr);

  /// @param name of the motion. timed(), made from the problem's revision, or failed() follows.
  void start(std::shared_ptr<const PreparedProblem> problem, planning::Path path,
             const std::string& name, const planning::TimingOptions& options);
  /// No answer is wanted any more.
  void forget() { job_.cancel(); }
  /// Returns whether an answer is still expected.
  [[nodiscard]] bool is_busy() const { return job_.is_busy(); }

 signals:
  void timed(const handway::gui::DerivedMotion& motion);
  void failed(const QString& message);

 private:
  LatestJob job_;
};

}  // namespace handway::gui
