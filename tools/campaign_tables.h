#pragma once

#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/campaigns/campaign_summary.h"
#include "report_document.h"

#include <span>

/// A campaign's results as tables for programs: full numbers, one kind of thing a row.
namespace handway::tools {

/// A row a run.
[[nodiscard]] ReportTable runs_table(const planning::Campaign& campaign,
                                     std::span<const planning::RunRecord> records);
/// A row for each problem and planner: success with its interval, and for each measure mean,
/// its interval, deviation, quartiles, least and most over the runs that found a path.
[[nodiscard]] ReportTable summary_table(const planning::Campaign& campaign,
                                        std::span<const planning::CampaignCell> cells);
/// A row for each step of the distribution of planning times.
[[nodiscard]] ReportTable ecdf_table(const planning::Campaign& campaign,
                                     std::span<const planning::CampaignCell> cells);
/// A row for each problem, planner and measure: what a box plot draws.
[[nodiscard]] ReportTable box_plot_table(const planning::Campaign& campaign,
                                         std::span<const planning::CampaignCell> cells);
/// A row for each pair of planners on a problem.
[[nodiscard]] ReportTable comparison_table(
    const planning::Campaign& campaign, std::span<const planning::CampaignComparison> comparisons);

}  // namespace handway::tools
