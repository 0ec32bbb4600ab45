#pragma once

#include "handway/planning/core/plan_result.h"
#include "handway/planning/planners/planner.h"
#include "model/document/prepared_problem.h"

#include <QObject>

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace handway::gui {

/// A replanned path, and the revision that it was planned in.
using DerivedResult = planning::Derived<planning::PlanResult>;

/// Keeps a path valid while its scene is edited: plans again on a thread of its own
/// with a dynamic roadmap. Only the latest scene counts: those that come faster than
/// they can be planned are skipped.
class LiveReplanner : public QObject {
  Q_OBJECT

 public:
  explicit LiveReplanner(QObject* parent = nullptr);
  ~LiveReplanner() override;

  /// Begins with a path that was planned for `problem`.
  void begin(std::shared_ptr<const PreparedProblem> problem, planning::Path path,
             const planning::PlanRequest& request);
  /// There is no path any more.
  void end();
  [[nodiscard]] bool is_active() const { return generation_ != ended_; }
  /// True while an answer is still to come.
  [[nodiscard]] bool is_busy() const { return is_active() && answered_ != asked_; }

  /// Asks for a path in a scene with the same robots. @param revision of that scene; none of a
  /// document's if it is only tried.
  void follow(std::shared_ptr<const geometric::Scene> scene, const planning::Revision& revision);

 signals:
  /// @param origin which means the path came from, one word.
  void replanned(const handway::gui::DerivedResult& result, const QString& origin);
  /// The scene has changed in a way that needs a new plan.
  void lost();

 private:
  struct Start {
    std::shared_ptr<const PreparedProblem> problem;
    planning::Path path;
    planning::PlanRequest request;
  };

  void work(const std::stop_token& stop);

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::optional<Start> start_;
  std::shared_ptr<const geometric::Scene> scene_;
  planning::Revision revision_;  ///< Of `scene_`.
  std::stop_source running_;     ///< Of the query that goes on.
  int ticket_ = 0;               ///< Of `scene_`.
  int wanted_ = 0;               ///< Generation of `start_`.
  int generation_ = 0;           ///< GUI thread only, as are the rest.
  int ended_ = 0;
  int asked_ = 0;
  int answered_ = 0;
  std::jthread thread_;
};

}  // namespace handway::gui
