#pragma once

#include "handway/planning/core/plan_result.h"
#include "handway/planning/planners/planner.h"
#include "model/document/prepared_problem.h"
#include "model/jobs/background.h"
#include "model/planning/palm_roadmap.h"

#include <QObject>
#include <QString>

#include <memory>
#include <stop_token>

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

}  // namespace handway::gui
