#pragma once

#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/campaigns/campaign_statistics.h"
#include "report_document.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace handway::tools {

/// Entries of a campaign that differ in two parameters alone, in all combinations of
/// at least two values of each.
struct ParameterGrid {
  std::string planner;                ///< As the registry calls it.
  std::string x;                      ///< Parameter across.
  std::string y;                      ///< Parameter upwards.
  std::vector<std::string> x_values;  ///< Numbers in rising order.
  std::vector<std::string> y_values;  ///< Numbers in rising order.
  std::vector<std::size_t> planners;  ///< Index of y · size of x_values + x: in the campaign.
};

/// The grids there are, each once, none a part of another; the parameter that comes first
/// in the planner's list is across.
[[nodiscard]] std::vector<ParameterGrid> parameter_grids(const planning::Campaign& campaign);

/// Median planning times of a grid on one problem as colours and numbers, the least in bold, with
/// the share of runs that found a path where it isn't all of them, and the scale of colours. @param
/// cells of the problem, a planner each.
[[nodiscard]] std::string heat_map_svg(const ParameterGrid& grid,
                                       std::span<const planning::CampaignCell> cells);

/// A row for each problem, grid and combination.
[[nodiscard]] ReportTable heat_map_table(const planning::Campaign& campaign,
                                         std::span<const ParameterGrid> grids,
                                         std::span<const planning::CampaignCell> cells);

}  // namespace handway::tools
