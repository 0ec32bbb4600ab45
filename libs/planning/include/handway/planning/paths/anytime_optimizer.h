#pragma once

#include "handway/planning/core/objective.h"
#include "handway/planning/core/planning_context.h"
#include "handway/planning/export.h"
#include "handway/planning/paths/path_optimizer.h"

#include <cstdint>
#include <limits>
#include <memory>

namespace handway::planning {

class CheaperPathSearch;

/// Optimises a path locally and globally, for as long as it is asked to.
///
/// A PathOptimizer improves the path until it converges. Then two trees search the whole joint
/// space, again and again, for paths along whatever route whose costs are below a bound
/// (CheaperPathSearch). A path that they find is optimised locally, and replaces the path if it is
/// then the cheapest. The bound is in turn somewhat above the cost of the path, since a path that
/// was just found can be shortened, and below it. Searches that are repeated below falling costs
/// converge to the least cost (Hauser, Zhou, "Asymptotically optimal planning by feasible
/// kinodynamic planning in a state-cost space", IEEE T-RO 32(6), 2016,
/// doi:10.1109/TRO.2016.2602363), as far as costs are sums: length and duration are. The mean
/// distance from the PMD subspace and the mean clearance are searched as if paths had the length of
/// the present one. Scenes with constraints on links are optimised locally alone.
///
/// Any-time and deterministic: the result after a number of rounds depends on the path, the weights
/// and the seed alone.
class HANDWAY_PLANNING_EXPORT AnytimeOptimizer {
 public:
  /// Number of checks without an improvement after which other routes are unlikely to be found.
  static constexpr std::uint64_t kPatience = 200'000;

  /// @param context outlives this. @param path all its motions are free.
  AnytimeOptimizer(PlanningContext& context, const ObjectiveWeights& weights, const Path& path,
                   std::uint64_t seed);
  AnytimeOptimizer(const AnytimeOptimizer&) = delete;
  AnytimeOptimizer& operator=(const AnytimeOptimizer&) = delete;
  ~AnytimeOptimizer();

  /// Continues in rounds of about 1000 checks until converged() or until the run has to end: the
  /// same number of rounds gives the same path, whether a number or a time was requested.
  /// @param go_on called before each round, with the checks of the rounds before; returns bool.
  /// @returns the checks of all rounds.
  template <typename GoOn>
  std::uint64_t advance_in_rounds(const GoOn& go_on) {
    std::uint64_t checks = 0;
    while (go_on(checks) && !converged() && !context_.interruption()) {
      advance_round();
      checks += kRound;
    }
    return checks;
  }

  /// Sets the number of checks without an improvement after which the path counts as converged; at
  /// first it never does before its cost is within a thousandth of least_cost().
  void set_patience(std::uint64_t checks) { patience_ = checks; }

  [[nodiscard]] bool converged() const;
  [[nodiscard]] Path path() const;
  [[nodiscard]] double cost() const;
  /// A cost that no path between these ends is below, see Objective::least_cost().
  [[nodiscard]] double least_cost() const { return least_cost_; }

 private:
  static constexpr std::uint64_t kRound = 1000;

  void advance_round();
  void search_other_routes();
  void begin_search();
  void improve_by(const Path& route);
  [[nodiscard]] bool searches_other_routes() const;

  PlanningContext& context_;
  ObjectiveWeights weights_;
  std::uint64_t seed_;
  double least_cost_;
  std::unique_ptr<PathOptimizer> local_;  ///< Optimises the cheapest path.
  std::unique_ptr<CheaperPathSearch> search_;
  std::uint64_t searches_ = 0;     ///< Begun so far, and …
  std::uint64_t cheapest_at_ = 0;  ///< … when the path became the cheapest.
  std::uint64_t fruitless_ = 0;    ///< Checks since then.
  std::uint64_t patience_ = std::numeric_limits<std::uint64_t>::max();
};

}  // namespace handway::planning
