#pragma once

#include "handway/planning/core/planning_context.h"
#include "handway/planning/export.h"
#include "handway/planning/paths/path.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/postures/posture_subspace.h"

#include <cstdint>

namespace handway::planning {

/// What a path is judged by, in joints normalised to [0, 1].
struct PathMeasure {
  double length = 0.0;
  /// The distance of the hand's posture from the subspace, summed along the
  /// path: 0 if the hand looks human all the way.
  double outside = 0.0;

  /// Mean distance from the subspace; 0 for a path without length.
  [[nodiscard]] double mean_distance() const { return length > 0.0 ? outside / length : 0.0; }
};

/// `outside` by the trapezium rule on parts of at most 0.05.
[[nodiscard]] HANDWAY_PLANNING_EXPORT PathMeasure measure(const PlanningProblem& problem,
                                                          const sampling::PostureSubspace& subspace,
                                                          const Path& path);

/// Shortens a path and keeps the hand human-like. First the shortest way over its
/// waypoints, then straight motions between points drawn at random on it; at
/// last, hand postures of waypoints give way to the closest of the subspace. A
/// change is kept if it is free and makes neither measure() of the path larger.
///
/// Source of the shortcuts: Geraerts, Overmars, "Creating high-quality paths for
/// motion planning", IJRR 26(8), 2007, section 4.
class HANDWAY_PLANNING_EXPORT ShortcutSmoothing {
 public:
  /// @param checks configurations to spend, by a single edge's more at most.
  /// @param seed of what is drawn: the same gives the same path.
  ShortcutSmoothing(PlanningContext& context, const sampling::PmdBasis& basis, std::uint64_t checks,
                    std::uint64_t seed);

  /// @pre every edge of `path` is free. Interrupted, it gives what it has by then.
  [[nodiscard]] Path smooth(const Path& path);

 private:
  [[nodiscard]] bool is_over() const;
  [[nodiscard]] std::uint64_t checks_left() const;
  void cut_corners(Path& path);
  void project_postures(Path& path);
  [[nodiscard]] bool improves(const Path& candidate, const Path& path) const;

  PlanningContext& context_;
  sampling::PostureSubspace subspace_;
  std::uint64_t last_check_;
  std::uint64_t seed_;
};

}  // namespace handway::planning
