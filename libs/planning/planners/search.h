#pragma once

#include "handway/planning/core/planning_context.h"
#include "handway/planning/core/planning_problem.h"

#include <cstdint>
#include <limits>
#include <optional>

namespace handway::planning {

/// How far a search may go before it pauses.
struct SearchBudget {
  std::uint64_t checks = std::numeric_limits<std::uint64_t>::max();   ///< Configurations.
  std::uint64_t samples = std::numeric_limits<std::uint64_t>::max();  ///< Draws.
};

/// A planner's search, which can pause and go on: what it finds does not depend
/// on where it paused.
class Search {
 public:
  explicit Search(PlanningContext& context) : context_(context) {}
  virtual ~Search();
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

  /// Goes on until `budget` is spent beyond what was spent before; the step that
  /// spends the last of it is finished. Looks at interruptions between steps.
  /// @returns how the search ended; nothing: it paused.
  [[nodiscard]] std::optional<PlanStatus> advance(const SearchBudget& budget);

  /// From start to goal, every edge free. @pre the search ended with kSolved.
  [[nodiscard]] virtual Path path() const = 0;

 protected:
  /// Of configurations looked at on motions that are certified later; normalised joints.
  static constexpr double kProbeSpacing = 0.05;

  [[nodiscard]] PlanningContext& context() const { return context_; }
  [[nodiscard]] PlanStatistics& statistics() const { return context_.statistics(); }

  // As the validator's, but what touches goes to the statistics' rejections.
  [[nodiscard]] bool sample_free(const Configuration& q);
  [[nodiscard]] bool edge_plausible(const Configuration& from, const Configuration& to, int count);

  /// The next sample or so, and what comes of it.
  [[nodiscard]] virtual std::optional<PlanStatus> step() = 0;

 private:
  PlanningContext& context_;
};

}  // namespace handway::planning
