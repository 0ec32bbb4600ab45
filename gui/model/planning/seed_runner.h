#pragma once

#include "handway/planning/core/plan_result.h"
#include "handway/planning/planners/planner.h"
#include "handway/planning/timing/time_path.h"
#include "handway/sampling/postures/posture_table.h"
#include "model/document/prepared_problem.h"
#include "model/jobs/background.h"
#include "model/playback/motion_analysis.h"

#include <QObject>
#include <QString>

#include <memory>
#include <stop_token>
#include <vector>

namespace handway::gui {

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

}  // namespace handway::gui
