#pragma once

#include "handway/planning/core/importer.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/core/revision.h"
#include "workers/background_threads.h"

#include <future>
#include <memory>
#include <stop_token>

namespace handway::gui {

/// A scene's planning problem, put together once, off the GUI thread (its
/// collision checker takes a while), for all who ask collision questions.
class PreparedProblem {
 public:
  using Problem = std::shared_ptr<const planning::PlanningProblem>;

  /// Begins at once. A scene without start or goal has both where its robot stands.
  /// @param before that of the scene before an edit, which saves work if it is ready; or null.
  PreparedProblem(planning::LoadedScene loaded, const planning::Revision& revision,
                  BackgroundThreads& threads, const PreparedProblem* before = nullptr);

  /// Of the scene: what is derived from the problem is made from it.
  [[nodiscard]] const planning::Revision& revision() const { return revision_; }

  /// Waits for the problem, at most until `stop` (null then).
  /// @throws InputError if the scene makes none.
  [[nodiscard]] Problem wait(const std::stop_token& stop) const;
  /// The problem if it is there by now and the scene makes one; else null.
  [[nodiscard]] Problem if_ready() const;

 private:
  planning::Revision revision_;
  std::shared_future<Problem> problem_;
};

}  // namespace handway::gui
