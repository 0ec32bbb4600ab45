#pragma once

#include "handway/planning/core/objective.h"
#include "handway/planning/core/plan_result.h"
#include "handway/planning/core/planning_context.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/export.h"
#include "handway/sampling/sequences/random_stream.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace handway::planning {

/// Lowers the cost of a free path under an Objective; every motion of the result is certified like
/// a planner's.
///
/// A path of many waypoints is pruned first. Then, in rounds, replacements of stretches are
/// sampled: straight motions, straight motions of the arm, the hand or a joint alone, the same
/// stretch nearer to the PMD subspace, the hand moving before the arm or after it; and moves of
/// single waypoints. Costs are known without a check of the motion, so that each round applies the
/// free replacement that saves most.
///
/// Any-time and deterministic: the result after a number of checks depends on the path, the weights
/// and the seed alone.
///
/// Sources: Geraerts, Overmars, "Creating high-quality paths for motion planning", IJRR 26(8),
/// 2007, section 4 (shortcuts, partial shortcuts).
class HANDWAY_PLANNING_EXPORT PathOptimizer {
 public:
  /// @param context outlives this. @param path all its motions are free.
  /// @param patience number of useless replacements in a row that ends it.
  PathOptimizer(PlanningContext& context, const ObjectiveWeights& weights, const Path& path,
                std::uint64_t seed, int patience = 200);

  /// Continues until `checks` configurations more were checked, by a single motion's more at most,
  /// until converged() or until the run has to end.
  void advance(std::uint64_t checks);

  /// Value of `patience` for optimising after planning.
  static constexpr int kThorough = 2000;
  /// Continues in rounds of 1000 checks until converged() or until the run has to end: the same
  /// number of rounds gives the same path, whether a number or a time was requested.
  /// @param go_on called before each round, with the checks of the rounds before; returns bool.
  /// @returns the checks of all rounds.
  template <typename GoOn>
  std::uint64_t advance_in_rounds(const GoOn& go_on) {
    constexpr std::uint64_t kRound = 1000;
    std::uint64_t checks = 0;
    while (go_on(checks) && !converged() && !context_.interruption()) {
      advance(kRound);
      checks += kRound;
    }
    return checks;
  }

  /// Returns whether another replacement is unlikely to help, after so many useless ones.
  [[nodiscard]] bool converged() const;

  /// Sets the patience, see the constructor.
  void set_patience(int patience) { patience_ = patience; }

  [[nodiscard]] Path path() const;
  /// Mean distance of the hand from the PMD subspace beyond the least one, of a hand that goes
  /// straight to it, stays in it and leaves it for the goal; 0 if that has no weight.
  [[nodiscard]] double avoidable_distance() const;
  /// Ratio of the path's length to that of the straight motion between its ends.
  [[nodiscard]] double detour() const;
  [[nodiscard]] double cost() const;

 private:
  using Point = Objective::Point;
  /// A place on the path.
  struct Place {
    std::size_t edge = 0;
    Point point;
  };

  /// Replacement of the path between two waypoints.
  struct Replacement {
    std::size_t first = 0;  ///< The waypoints at its ends, which stay.
    std::size_t last = 0;
    std::vector<Point> chain;         ///< The new path between them, both included; …
    std::size_t first_changed = 0;    ///< … new from this one of its points …
    std::size_t last_changed = 0;     ///< … to this one.
    std::vector<MotionSums> motions;  ///< Motions of the chain.
    double cost = 0.0;                ///< Cost of the path with it and of the added waypoints.

    /// Returns the points whose motions have to be checked.
    [[nodiscard]] std::span<const Point> changed() const {
      return std::span(chain).subspan(first_changed, last_changed - first_changed + 1);
    }

    /// Returns whether it removes a single waypoint.
    [[nodiscard]] bool is_removal() const { return chain.size() == 2 && last == first + 2; }
  };

  [[nodiscard]] std::uint64_t spent() const;
  [[nodiscard]] std::uint64_t checks_left() const;
  [[nodiscard]] bool is_over() const;
  [[nodiscard]] bool has_subspace() const;

  [[nodiscard]] bool measures_distances() const;

  void prune(std::size_t first, std::size_t last);
  void shorten(std::uint64_t checks);
  void replace_at_random();
  [[nodiscard]] std::optional<Replacement> draw_replacement();
  [[nodiscard]] std::vector<Point> draw_inner(const Place& from, const Place& to);
  [[nodiscard]] std::optional<Replacement> draw_waypoint_move();
  [[nodiscard]] std::optional<Replacement> replacement(const Place& from, const Place& to,
                                                       const std::vector<Point>& inner);
  bool apply(const Replacement& made);

  [[nodiscard]] Place place_at(double length_before) const;
  [[nodiscard]] Place at_waypoint(std::size_t waypoint) const;
  [[nodiscard]] bool all_free(std::span<const Point> points);
  void set_points(std::vector<Point> points);
  void add_up();

  PlanningContext& context_;
  Objective objective_;
  geometric::JointIndices planned_;  ///< PlanningProblem::planned_joints().
  sampling::RandomStream draw_;
  std::vector<Point> points_;
  std::vector<MotionSums> motions_;  ///< Between them.
  std::vector<bool> is_needed_;      ///< Per point: without it the path was not free.
  MotionSums sum_;                   ///< Sum of all motions.
  std::uint64_t last_check_ = 0;
  int patience_;
  int fruitless_ = 0;  ///< Replacements since the last useful one.
  bool begun_ = false;
};

/// Makes `found`, optimised by a PathOptimizer, the path of `result`; its time is added to the
/// result's smoothing time.
/// @param checks number of configurations for every 16 waypoints.
/// @param most_rounds largest number of rounds of `checks` for a path whose hand is farther from
/// the PMD subspace than its ends require, and as many again for a path with a long detour. If
/// above 1, half a round suffices for other paths if the length alone counts.
HANDWAY_PLANNING_EXPORT void smooth_result(PlanningContext& context,
                                           const ObjectiveSettings& objective, int checks,
                                           const Path& found, PlanResult& result,
                                           int most_rounds = 1);

}  // namespace handway::planning
