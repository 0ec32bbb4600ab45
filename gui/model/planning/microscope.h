#pragma once

#include "handway/geometric/scene/scene.h"
#include "handway/planning/core/planner.h"
#include "model/document/prepared_problem.h"
#include "model/jobs/latest_job.h"
#include "model/planning/recorded_run.h"

#include <QObject>
#include <QString>

#include <cstddef>
#include <memory>
#include <vector>

namespace handway::gui {

/// Which steps are stopped at.
enum class StepFilter {
  kAll,
  kSamples,  ///< Questions about the arm's and the hand's draws, and new nodes.
  kEdges,    ///< Nodes, local plans and edges.
};

/// Records a run of a planner that tells its steps, and goes through them.
class Microscope : public QObject {
  Q_OBJECT

 public:
  explicit Microscope(QObject* parent = nullptr) : QObject(parent) {}

  /// recorded() or failed() follows, unless it is forgotten before.
  /// @param palm link whose place stands for a node.
  void record(std::shared_ptr<planning::Planner> planner,
              std::shared_ptr<const PreparedProblem> problem, const planning::PlanRequest& request,
              int palm);
  /// Forgets the run, and ends one that is being recorded.
  void forget();
  [[nodiscard]] bool is_recording() const { return job_.is_busy(); }

  /// Null: none.
  [[nodiscard]] const std::shared_ptr<const RecordedRun>& run() const { return run_; }
  /// Palm of each node of the roadmap (world, m).
  [[nodiscard]] const std::vector<Eigen::Vector3d>& palms() const { return palms_; }
  /// The step that has just been done. @pre there is a run.
  [[nodiscard]] std::size_t position() const { return position_; }
  [[nodiscard]] const RecordedStep& step() const { return run_->steps[position_]; }

  void go_to(std::size_t position);
  /// To the next step (or back to the one before) that the filter lets through.
  /// @returns false at the end.
  bool go(int direction, StepFilter filter);

 signals:
  void recorded();
  void failed(const QString& message);
  /// At another step, or there is no run any more.
  void moved();

 private:
  LatestJob job_;
  std::shared_ptr<const RecordedRun> run_;
  std::vector<Eigen::Vector3d> palms_;
  std::size_t position_ = 0;
};

}  // namespace handway::gui
