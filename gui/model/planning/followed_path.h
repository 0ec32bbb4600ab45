#pragma once

#include "handway/planning/replanning/living_roadmap.h"

#include <memory>
#include <stop_token>

namespace handway::gui {

/// A path that follows the edits of its scene.
class FollowedPath {
 public:
  /// @param path planned for `problem`.
  FollowedPath(const planning::PlanningProblem& problem, planning::Path path,
               const planning::PlanRequest& request, const std::stop_token& stop);

  /// Brings the roadmap to another scene. @returns false if it can't: what robots or
  /// carried objects do has changed.
  [[nodiscard]] bool move_to(const geometric::Scene& scene);
  [[nodiscard]] planning::PlanResult plan(const std::stop_token& stop);
  [[nodiscard]] planning::ReplanSource source() const { return roadmap_.report().source; }

 private:
  planning::LivingRoadmap roadmap_;
  planning::PlanRequest request_;
  std::shared_ptr<const geometric::Scene> scene_;
};

}  // namespace handway::gui
