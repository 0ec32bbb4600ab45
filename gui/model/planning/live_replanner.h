#pragma once

#include "handway/planning/core/plan_result.h"
#include "handway/planning/planners/planner.h"
#include "model/document/prepared_problem.h"
#include "model/jobs/background.h"

#include <QObject>

#include <functional>
#include <memory>
#include <stop_token>

namespace handway::planning {
class DynamicRoadmap;
}

namespace handway::gui {

/// A replanned path, and the revision that it was planned in.
using DerivedResult = planning::Derived<planning::PlanResult>;

/// Keeps a path valid while its scene is edited: plans again in the background
/// with a dynamic roadmap. Only the latest scene counts: those that come faster than
/// they can be planned are skipped.
class LiveReplanner : public QObject {
  Q_OBJECT

 public:
  explicit LiveReplanner(QObject* parent = nullptr);

  /// Begins with a path that was planned for `problem`.
  void begin(std::shared_ptr<const PreparedProblem> problem, planning::Path path,
             const planning::PlanRequest& request);
  /// Ends replanning, as there is no path any more.
  void end();
  [[nodiscard]] bool is_active() const { return followed_ != nullptr; }
  /// Returns whether an answer is still expected.
  [[nodiscard]] bool is_busy() const { return job_.is_busy(); }

  /// Requests a path in the scene of an edit. @param problem of `scene`.
  void follow(std::shared_ptr<const geometric::Scene> scene,
              std::shared_ptr<const PreparedProblem> problem);
  /// Requests a path in a scene that is only tried; the result has no revision of a document.
  void try_scene(std::shared_ptr<const geometric::Scene> scene);

 signals:
  /// @param origin how the path was found, a few words.
  void replanned(const handway::gui::DerivedResult& result, const QString& origin);
  /// The scene has changed in a way that needs a new plan.
  void lost();

 private:
  struct Followed;
  /// Applies a change of the scene; returns false if it needs a new plan.
  using Change = std::function<bool(planning::DynamicRoadmap&, const std::stop_token&)>;

  void replan(Change change, const planning::Revision& revision);

  std::shared_ptr<Followed> followed_;  ///< For the job; null: there is no path.
  LatestJob job_;
};

}  // namespace handway::gui
