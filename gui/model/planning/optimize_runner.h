#pragma once

#include "handway/planning/core/objective.h"
#include "handway/planning/core/plan_result.h"
#include "model/document/prepared_problem.h"
#include "model/jobs/background.h"

#include <QObject>
#include <QString>

#include <memory>
#include <optional>
#include <stop_token>

namespace handway::gui {

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
  planning::PathCost cost;              ///< Cost of the present path.
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

}  // namespace handway::gui
