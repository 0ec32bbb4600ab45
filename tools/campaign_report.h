#pragma once

#include "campaign_command.h"
#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/campaigns/campaign_statistics.h"
#include "handway/report/document/document.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace handway::tools {

/// Entries of a campaign that differ in two parameters alone, in all combinations of
/// at least two values of each.
struct ParameterGrid {
  std::string planner;                ///< Name in the registry.
  std::string x;                      ///< Parameter across.
  std::string y;                      ///< Parameter upwards.
  std::vector<std::string> x_values;  ///< Numbers in rising order.
  std::vector<std::string> y_values;  ///< Numbers in rising order.
  std::vector<std::size_t> planners;  ///< Index of y · size of x_values + x: in the campaign.
};

/// All grids, each once, none a part of another; the parameter that comes first in the planner's
/// list is across.
[[nodiscard]] std::vector<ParameterGrid> parameter_grids(const planning::Campaign& campaign);

/// Returns the median planning times of a grid on one problem, with the share of runs that found a
/// path if it is below 100 %. @param cells of the problem, a planner each.
[[nodiscard]] report::HeatMap heat_map(const ParameterGrid& grid,
                                       std::span<const planning::CampaignCell> cells);

/// A row for each problem, grid and combination.
[[nodiscard]] report::Table heat_map_table(const planning::Campaign& campaign,
                                           std::span<const ParameterGrid> grids,
                                           std::span<const planning::CampaignCell> cells);

/// Writes into `folder`: report.md with drawings/N.svg, report.html, summary.csv, runs.csv,
/// ecdf.csv, boxplot.csv, comparisons.csv and one OMPL benchmark log per problem in `ompl/`.
/// @throws InputError if that fails.
void write_campaign_report(const planning::Campaign& campaign, const CampaignOutcome& outcome,
                           const std::filesystem::path& folder);

/// Returns the share of runs that found a path, with Wilson's 95 % interval, in %.
[[nodiscard]] report::Estimate success(const planning::CampaignCell& cell);

/// Returns the machine that the times depend on, and how the runs were carried out.
[[nodiscard]] report::Table machine_table(const CampaignOutcome& outcome);

/// The planners compared, with their parameters: one column per planner.
[[nodiscard]] report::Table parameter_table(const planning::Campaign& campaign);

/// The runs on one problem as OMPL's benchmark log, from which `ompl_benchmark_statistics` makes a
/// database for Planner Arena (https://ompl.kavrakilab.org/benchmark.html).
/// @param cells of one problem, one a planner.
[[nodiscard]] std::string ompl_log(const planning::Campaign& campaign,
                                   std::span<const planning::CampaignCell> cells);

}  // namespace handway::tools
