#pragma once

#include "handway/planning/core/planning_context.h"
#include "planners/search.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace handway::planning {

/// A search that takes part in a Portfolio; NodeEvent::search is its place in the list.
struct PortfolioMember {
  std::string name;     ///< Words for the reason.
  int first_round = 0;  ///< Starts in this round.
  std::function<std::unique_ptr<Search>(PlanningContext&)> make;
  const PlanningProblem* problem = nullptr;  ///< Other ends; null: the portfolio's own problem.
};

/// Lets several searches run on one problem until one solves it.
///
/// The portfolio is run in rounds. In each, every member may check as many
/// configurations as the round allows, twice as many as in the one before. The winner is
/// the first in order to solve in the earliest round, independent of the clock. The
/// order is that of the list, but the first member goes last from the third round on. So
/// the result is the same for any number of threads. Searches that can't win any more
/// are stopped.
class Portfolio {
 public:
  /// @param samples that all members may draw together.
  Portfolio(PlanningContext& context, std::vector<PortfolioMember> members, std::uint64_t samples);
  ~Portfolio();
  Portfolio(const Portfolio&) = delete;
  Portfolio& operator=(const Portfolio&) = delete;

  /// Runs to the end. Adds up all members' work in the context's statistics, apart from work of a
  /// round that its winner made unnecessary.
  [[nodiscard]] PlanStatus run();

  /// @pre run() gave kSolved.
  [[nodiscard]] const PortfolioMember& winner() const;
  [[nodiscard]] Path path() const;

 private:
  struct Run;

  [[nodiscard]] std::optional<PlanStatus> run_round(int round);
  void advance(const std::vector<Run*>& runs, const SearchBudget& budget);
  void publish(const std::vector<Run*>& runs);

  PlanningContext& context_;
  std::uint64_t samples_;
  std::vector<std::unique_ptr<Run>> runs_;
  PlanStatistics before_;  ///< Statistics of the context before the portfolio.
  const Run* winner_ = nullptr;
};

}  // namespace handway::planning
