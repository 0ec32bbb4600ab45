#pragma once

#include "handway/geometric/collision/collision_checker.h"
#include "handway/geometric/collision/narrow_phase/closest_points.h"
#include "model/document/prepared_problem.h"
#include "model/jobs/background.h"

#include <QObject>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace handway::gui {

/// Colliding bodies of one configuration, and the constraints that it violates.
struct CollisionReport {
  std::vector<geometric::NamedPair> collisions;
  std::vector<std::string> violated;  ///< See violated_constraints().
  /// The closest pair of a free configuration; nothing if all are farther apart
  /// than CollisionMonitor::kNear.
  std::optional<geometric::NamedPair> closest;
  std::optional<geometric::ClosestPoints> points;  ///< Closest points of that pair.
};

/// Checks the posture on screen in the background. Only the latest posture
/// counts: those that come faster than they can be checked are skipped.
class CollisionMonitor : public QObject {
  Q_OBJECT

 public:
  static constexpr double kNear = 0.10;  ///< m

  explicit CollisionMonitor(QObject* parent = nullptr);

  /// Sets the problem; null: nothing to check.
  void set_problem(std::shared_ptr<const PreparedProblem> problem);
  /// @param q of the first robot, shape [variable_count].
  void check(const geometric::Configuration& q);
  /// Returns whether an answer is still expected.
  [[nodiscard]] bool is_busy() const { return job_.is_busy(); }

 signals:
  void checked(const handway::gui::CollisionReport& report);
  /// Emitted when the last report is for another scene, and a new one takes a while.
  void outdated();
  void failed(const QString& message);

 private:
  /// Problem and checker of the job.
  struct Checks {
    OwnChecker checker;
    std::unique_ptr<geometric::ClosestPointFinder> finder = nullptr;
  };

  std::shared_ptr<Checks> checks_;  ///< Null: nothing to check.
  LatestJob job_;
};

}  // namespace handway::gui
