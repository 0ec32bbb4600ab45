#pragma once

#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/campaigns/mann_whitney.h"
#include "handway/planning/campaigns/run_record.h"
#include "handway/planning/campaigns/sample_statistics.h"
#include "handway/planning/export.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace handway::planning {

/// A number of a run that reports tell about.
struct RunMeasure {
  std::string key;    ///< In files, for example "time_s".
  std::string label;  ///< For people, with its unit.
  std::function<double(const RunRecord&)> value;
};

/// Those that every report has, planning time first.
[[nodiscard]] HANDWAY_PLANNING_EXPORT const std::vector<RunMeasure>& run_measures();

/// The runs of a planner on a problem.
struct CampaignCell {
  int problem = 0;
  int planner = 0;
  std::vector<RunRecord> runs;

  [[nodiscard]] HANDWAY_PLANNING_EXPORT std::size_t solved() const;
  /// Of the runs that found a path.
  [[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<double> of_solved(
      const RunMeasure& measure) const;
  /// Planning times of all runs, s; of those without a path infinite.
  [[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<double> times() const;
};

/// Two planners' planning times on one problem.
struct CampaignComparison {
  int problem = 0;
  int first = 0;   ///< Planner.
  int second = 0;  ///< Planner.
  MannWhitney test;
  double adjusted_p = 1.0;  ///< Holm, over all comparisons on the problem.
};

/// A cell for each problem and planner, problem by problem; those without runs too.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<CampaignCell> campaign_cells(
    const Campaign& campaign, std::span<const RunRecord> records);

/// All pairs of planners that have runs, problem by problem. A run without a path takes
/// longer than all that found one.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<CampaignComparison> compare_planners(
    std::span<const CampaignCell> cells);

}  // namespace handway::planning
