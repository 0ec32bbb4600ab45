#pragma once

#include "handway/planning/core/planning_problem.h"
#include "handway/planning/edits/scene_state.h"
#include "handway/planning/tasks/task.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::planning {

/// The scene of a stage, ready for checks: what stands where, what the hand carries, and which
/// contacts are allowed.
struct TaskWorld {
  SceneState state;
  std::shared_ptr<const PlanningProblem> problem;

  /// Prepares a scene for motions that begin at `q`; a goal that it has is removed.
  /// @throws geometric::PreparationStopped if `stop` is requested.
  [[nodiscard]] static TaskWorld of(const SceneState& state, const Configuration& q,
                                    const std::stop_token& stop);

  /// Describes the first conflict of a path, or of the joint limits; nothing if it is free.
  [[nodiscard]] std::optional<std::string> conflict(std::span<const Configuration> waypoints,
                                                    const std::stop_token& stop) const;
  /// Returns the problem of moving from one configuration to another one in this world.
  [[nodiscard]] PlanningProblem motion(const Configuration& from, const Configuration& to) const;
};

/// Returns `state` with the ends of a path as start and goal of its scene.
[[nodiscard]] SceneState with_ends(const SceneState& state, const Configuration& from,
                                   const Configuration& to);

/// Returns `state` in which some links may touch an object.
[[nodiscard]] SceneState with_contacts(const SceneState& state,
                                       const std::vector<std::string>& links,
                                       const std::string& object);

/// Counts the candidates of each stage, and keeps the reason of the first failure.
class TrialLog {
 public:
  void succeed(std::size_t step, StageKind kind) { ++entry(step, kind).tried; }
  /// @param q shows the failure.
  void fail(std::size_t step, StageKind kind, const std::string& reason, const Configuration& q);

  [[nodiscard]] const std::vector<StageTrials>& trials() const { return trials_; }

 private:
  StageTrials& entry(std::size_t step, StageKind kind);

  std::vector<StageTrials> trials_;
};

}  // namespace handway::planning
