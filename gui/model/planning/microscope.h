#pragma once

#include "handway/geometric/scene/scene.h"
#include "handway/planning/core/observer.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/planners/planner.h"
#include "model/document/prepared_problem.h"
#include "model/jobs/background.h"

#include <QObject>
#include <QString>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace handway::gui {

/// One step of a run, kept.
struct RecordedStep {
  planning::AlgorithmStep step;  ///< Its q is null: see `sample`.
  int sample = -1;               ///< Index into RecordedRun::samples; -1: none.
};

/// A run of pmd-prm or full-prm, step by step.
struct RecordedRun {
  std::vector<RecordedStep> steps;
  std::vector<geometric::Configuration> samples;
  std::vector<int> nodes;  ///< Index in samples of each node of the roadmap.
  std::vector<std::pair<std::string, std::string>> pairs;  ///< Names of the world's pairs.
  std::uint64_t left_out = 0;                              ///< Steps after the last one kept.
  planning::PlanResult result;
  /// Parameters by which the run departed from the paper's listings, as "rho_max 0.05 (printed:
  /// 0)".
  std::vector<std::string> departures;

  /// The roadmap's nodes, and its edges, once `count` steps are done.
  [[nodiscard]] int nodes_after(std::size_t count) const;
  [[nodiscard]] std::vector<std::pair<int, int>> edges_after(std::size_t count) const;
};

/// Records the first steps of a run, limited so that memory stays small.
class RunRecorder : public planning::AlgorithmObserver {
 public:
  explicit RunRecorder(std::size_t most_steps) : most_steps_(most_steps) {}

  void on_step(const planning::AlgorithmStep& step) override;
  /// @param world of the problem's checker, which names pairs.
  [[nodiscard]] RecordedRun take(planning::PlanResult result,
                                 const geometric::CollisionWorld& world);

 private:
  std::size_t most_steps_;
  RecordedRun run_;
};

/// Kinds of steps to stop at.
enum class StepFilter {
  kAll,
  kSamples,  ///< Questions about the arm's and the hand's draws, and new nodes.
  kEdges,    ///< Nodes, local plans and edges.
};

/// Records a run of a planner that reports its steps, and goes through them.
class Microscope : public QObject {
  Q_OBJECT

 public:
  explicit Microscope(QObject* parent = nullptr);

  /// recorded() or failed() follows, unless it is forgotten before.
  /// @param palm link whose place stands for a node.
  void record(std::shared_ptr<planning::Planner> planner,
              std::shared_ptr<const PreparedProblem> problem, const planning::PlanRequest& request,
              int palm);
  /// Forgets the run, and ends one that is being recorded.
  void forget();
  [[nodiscard]] bool is_recording() const { return job_.is_busy(); }

  /// Returns the run, or null.
  [[nodiscard]] const std::shared_ptr<const RecordedRun>& run() const { return run_; }
  /// Palm of each node of the roadmap (world, m).
  [[nodiscard]] const std::vector<Eigen::Vector3d>& palms() const { return palms_; }
  /// The step that has just been done. @pre there is a run.
  [[nodiscard]] std::size_t position() const { return position_; }
  [[nodiscard]] const RecordedStep& step() const { return run_->steps[position_]; }

  void go_to(std::size_t position);
  /// Moves to the next step (or back to the one before) that the filter accepts.
  /// @returns false at the end.
  bool go(int direction, StepFilter filter);

 signals:
  void recorded();
  void failed(const QString& message);
  /// Emitted when the step has changed, or there is no run any more.
  void moved();

 private:
  LatestJob job_;
  std::shared_ptr<const RecordedRun> run_;
  std::vector<Eigen::Vector3d> palms_;
  std::size_t position_ = 0;
};

}  // namespace handway::gui
