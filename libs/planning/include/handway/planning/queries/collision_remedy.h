#pragma once

#include "handway/geometric/collision/narrow_phase/contact.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"

#include <string>
#include <vector>

namespace handway::planning {

/// A change of the scene that may be meant where a configuration is in collision.
struct CollisionRemedy {
  enum class Kind {
    kHollow,      ///< The robot is inside of closed objects that are taken as filled.
    kTouchLinks,  ///< An attached object touches links that may be those that hold it.
  };

  Kind kind = Kind::kHollow;
  std::vector<std::string> objects;  ///< For kTouchLinks a single one.
  std::vector<std::string> links;    ///< For kTouchLinks; else none.
};

/// Returns the changes of the scene that would end some of the collisions of `q`, hollow objects
/// first.
/// @param contacts of `q`, as find_contacts() gives them.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<CollisionRemedy> find_remedies(
    const PlanningProblem& problem, const Configuration& q,
    const std::vector<geometric::Contact>& contacts);

/// Returns the scene with that change.
[[nodiscard]] HANDWAY_PLANNING_EXPORT geometric::Scene remedied(const geometric::Scene& scene,
                                                                const CollisionRemedy& remedy);

/// Returns a sentence for authors of scene files with the text for that change.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::string describe_remedy(const geometric::Scene& scene,
                                                                  const CollisionRemedy& remedy);

}  // namespace handway::planning
