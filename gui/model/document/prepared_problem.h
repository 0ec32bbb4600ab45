#pragma once

#include "handway/planning/core/importer.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/core/revision.h"
#include "model/document/preparation_queue.h"

#include <future>
#include <memory>
#include <stop_token>

namespace handway::gui {

/// A scene's planning problem, put together once, off the GUI thread (its
/// collision checker takes a while), for all who ask collision questions. The preparation ends
/// once nobody holds it any more.
class PreparedProblem {
 public:
  using Problem = std::shared_ptr<const planning::PlanningProblem>;

  /// Begins at once. A scene without start or goal has both where its robot stands.
  /// @param before that of the scene before an edit, which saves work; null for a scene that was
  /// just opened.
  PreparedProblem(planning::LoadedScene loaded, const planning::Revision& revision,
                  PreparationQueue& queue, const PreparedProblem* before = nullptr);
  ~PreparedProblem();
  PreparedProblem(const PreparedProblem&) = delete;
  PreparedProblem& operator=(const PreparedProblem&) = delete;

  /// Of the scene: what is derived from the problem is made from it.
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

}  // namespace handway::gui
