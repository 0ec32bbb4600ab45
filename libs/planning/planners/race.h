#pragma once

#include "handway/planning/core/observer.h"
#include "handway/planning/core/planning_context.h"
#include "planners/search.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace handway::planning {

/// Keeps the events of a search, to replay them later.
class EventLog final : public Observer {
 public:
  void on_node(const NodeEvent& node) override;
  void on_edge(int from, int to) override;

  /// Tells `observer` what came since the last time. Node n gets the number
  /// `stride` * n + `offset`, so that several searches' nodes differ, and is said to be of
  /// search `offset`.
  void replay(Observer& observer, int offset, int stride);

 private:
  struct Node {
    int id;
    geometric::Configuration q;
    int pmd_count;
    double step;
    double rho_a;
  };
  using Edge = std::pair<int, int>;

  std::vector<std::variant<Node, Edge>> events_;
};

/// A search that takes part in a Race; NodeEvent::search is its place in the list.
struct Racer {
  std::string name;     ///< In words, for the reason.
  int first_round = 0;  ///< Starts in this round.
  std::function<std::unique_ptr<Search>(PlanningContext&)> make;
  const PlanningProblem* problem = nullptr;  ///< Between other ends; null: the race's own.
};

/// Lets several searches run on one problem until one solves it.
///
/// The race goes in rounds. In each, every racer may check as many configurations
/// as the round allows, twice as many as in the one before. The winner is the
/// first in order to solve in the earliest round, whichever was done first by the
/// clock; the order is that of the list, but the first racer goes last from the
/// third round on: so any number of threads finds the same. Searches that can't win
/// any more are stopped.
class Race {
 public:
  /// @param samples that all racers may draw together.
  Race(PlanningContext& context, std::vector<Racer> racers, std::uint64_t samples);
  ~Race();
  Race(const Race&) = delete;
  Race& operator=(const Race&) = delete;

  /// To the end. Adds up what all racers did in the context's statistics, apart
  /// from work of a round that its winner made needless.
  [[nodiscard]] PlanStatus run();

  /// @pre run() gave kSolved.
  [[nodiscard]] const std::string& winner() const;
  [[nodiscard]] const PlanningProblem* winner_problem() const;  ///< Racer::problem.
  [[nodiscard]] Path path() const;

 private:
  struct Lane;

  [[nodiscard]] std::optional<PlanStatus> run_round(int round);
  void run_lanes(const std::vector<Lane*>& lanes, const SearchBudget& budget);
  void publish(const std::vector<Lane*>& lanes);

  PlanningContext& context_;
  std::uint64_t samples_;
  std::vector<std::unique_ptr<Lane>> lanes_;
  PlanStatistics before_;  ///< What the context had done before the race.
  const Lane* winner_ = nullptr;
};

}  // namespace handway::planning
