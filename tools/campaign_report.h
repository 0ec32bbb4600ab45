#pragma once

#include "campaign_command.h"
#include "handway/planning/campaigns/campaign.h"
#include "report_document.h"

#include <filesystem>

namespace handway::tools {

/// Writes into `folder`: report.md with drawings/N.svg, report.html, summary.csv, runs.csv,
/// ecdf.csv, boxplot.csv, comparisons.csv and an OMPL benchmark log a problem in `ompl/`.
/// @throws InputError if that can't be done.
void write_campaign_report(const planning::Campaign& campaign, const CampaignOutcome& outcome,
                           const std::filesystem::path& folder);

/// What the times depend on, and how the runs were carried out.
[[nodiscard]] ReportTable machine_table(const CampaignOutcome& outcome);

/// The planners that are compared, with their parameters: a column a planner.
[[nodiscard]] ReportTable parameter_table(const planning::Campaign& campaign);

}  // namespace handway::tools
