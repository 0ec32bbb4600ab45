#pragma once

#include "handway/planning/core/objective.h"
#include "handway/planning/core/planning_context.h"
#include "handway/planning/export.h"
#include "handway/planning/paths/path.h"
#include "handway/sampling/sequences/random_stream.h"

#include <cstdint>
#include <vector>

namespace handway::planning {

/// Lowers the cost of a free path, as an Objective measures it; every motion of the result is
/// certified like a planner's.
///
/// With a PMD subspace the path is first led into it as early and out of it as late as obstacles
/// allow: the cheapest path over the given waypoints, points between them and the same with the
/// hand in the subspace, whose motions are checked only where that path leads. Then, in rounds,
/// stretches are replaced at random: by straight motions, by straight motions of the arm, the hand
/// or a joint alone, by the same stretch nearer to the subspace; and single waypoints are moved.
/// What costs less and is free stays.
///
/// Any-time and deterministic: what it has after a number of checks depends on the path, the
/// weights and the seed alone.
///
/// Sources: Geraerts, Overmars, "Creating high-quality paths for motion planning", IJRR 26(8),
/// 2007, section 4 (shortcuts, partial shortcuts); Bohlin, Kavraki, "Path planning using lazy
/// PRM", ICRA 2000, doi:10.1109/ROBOT.2000.844107 (motions checked late).
class HANDWAY_PLANNING_EXPORT PathOptimizer {
 public:
  /// @param context outlives this. @param path all its motions are free.
  /// @param patience replacements in a row without use that end it.
  PathOptimizer(PlanningContext& context, const ObjectiveWeights& weights, const Path& path,
                std::uint64_t seed, int patience = 200);

  /// Goes on until `checks` configurations more were checked, by a single motion's more at most,
  /// until converged() or until the run has to end.
  void advance(std::uint64_t checks);

  /// `patience` for going on after planning.
  static constexpr int kThorough = 500;
  /// Goes on in rounds of 1000 checks until converged() or until the run has to end: as many rounds
  /// give the same path, whether they were asked for or are what some seconds sufficed for.
  /// @param go_on asked before each round, with the checks of the rounds before; returns bool.
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

  /// So many replacements in a row were of no use that another one is not expected to be.
  [[nodiscard]] bool converged() const;

  [[nodiscard]] Path path() const;
  [[nodiscard]] double cost() const;

 private:
  using Point = Objective::Point;
  /// A place on the path.
  struct Place {
    std::size_t edge = 0;
    Point point;
  };

  [[nodiscard]] std::uint64_t spent() const;
  [[nodiscard]] std::uint64_t checks_left() const;
  [[nodiscard]] bool is_over() const;
  [[nodiscard]] bool has_subspace() const;

  void prune(std::size_t first, std::size_t last);
  void lead_into_subspace();
  void replace_at_random();
  [[nodiscard]] std::vector<Point> replacement(const Place& from, const Place& to);
  bool try_stretch(const Place& from, const Place& to, const std::vector<Point>& inner);
  bool move_waypoint();

  [[nodiscard]] Place place_at(double length_before) const;
  [[nodiscard]] Place at_waypoint(std::size_t waypoint) const;
  [[nodiscard]] bool all_free(const std::vector<Point>& points);
  void set_points(std::vector<Point> points);
  void add_up();

  PlanningContext& context_;
  Objective objective_;
  sampling::RandomStream draw_;
  std::vector<Point> points_;
  std::vector<MotionSums> motions_;  ///< Between them.
  MotionSums sum_;                   ///< Of all motions.
  std::uint64_t last_check_ = 0;
  int patience_;
  int fruitless_ = 0;  ///< Replacements since one was of use.
  bool led_ = false;   ///< lead_into_subspace() is done.
};

}  // namespace handway::planning
