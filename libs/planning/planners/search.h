#pragma once

#include "handway/planning/core/planning_context.h"
#include "handway/planning/core/planning_problem.h"

#include <cstdint>
#include <limits>
#include <optional>

namespace handway::planning {

/// Budget of a search until it pauses.
struct SearchBudget {
  std::uint64_t checks = std::numeric_limits<std::uint64_t>::max();   ///< Configurations.
  std::uint64_t samples = std::numeric_limits<std::uint64_t>::max();  ///< Draws.
};

/// A planner's search, which can pause and continue: its results do not depend on the
/// pauses.
class Search {
 public:
  explicit Search(PlanningContext& context) : context_(context) {}
  virtual ~Search() = default;
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

  /// Continues until `budget` more is spent; the step that spends the last of it is finished.
  /// Checks for interruptions between steps.
  /// @returns how the search ended; nothing: it paused.
  [[nodiscard]] std::optional<PlanStatus> advance(const SearchBudget& budget) {
    const PlanStatistics& now = statistics();
    const std::uint64_t checks_before = now.checks();
    const std::uint64_t samples_before = now.samples;
    do {
      if (const auto interruption = context_.interruption()) {
        return interruption;
      }
      if (const auto end = step()) {
        return end;
      }
    } while (now.checks() - checks_before < budget.checks &&
             now.samples - samples_before < budget.samples);
    return std::nullopt;
  }

  /// From start to goal, every edge free. @pre the search ended with kSolved.
  [[nodiscard]] virtual Path path() const = 0;

 protected:
  /// Spacing of configurations checked on motions that are certified later; normalised joints.
  static constexpr double kProbeSpacing = 0.05;

  [[nodiscard]] PlanningContext& context() const { return context_; }
  [[nodiscard]] PlanStatistics& statistics() const { return context_.statistics(); }

  // Checks as the validator does, and adds colliding pairs to the statistics' rejections.
  [[nodiscard]] bool sample_free(const Configuration& q) {
    return !rejected(context_.validator().collision(q), q);
  }
  [[nodiscard]] bool edge_plausible(const Configuration& from, const Configuration& to, int count) {
    return !rejected(context_.validator().edge_probe(from, to, count), 0.5 * (from + to));
  }

  /// Processes the next sample or so.
  [[nodiscard]] virtual std::optional<PlanStatus> step() = 0;

 private:
  [[nodiscard]] bool rejected(const std::optional<int>& pair, const Configuration& q) {
    if (pair) {
      context_.count_rejection(*pair, arm_progress(context_.problem(), q));
    }
    return pair.has_value();
  }

  PlanningContext& context_;
};

}  // namespace handway::planning
