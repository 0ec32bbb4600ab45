#pragma once

#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/campaigns/campaign_summary.h"
#include "paper_tables.h"
#include "report_document.h"

#include <string>
#include <vector>

/// The paper's tables with our figures beside the published ones.
namespace handway::tools {

/// A column of measured figures.
struct MeasuredColumn {
  std::string label;
  planning::CampaignCell cell;
};

/// Runs, success with Wilson's interval, then the paper's rows: published value, and for
/// each column the mean with its 95 % interval over the runs that found a path; at the end the
/// published time by the mean time.
/// @param published which column of the rows.
[[nodiscard]] ReportTable compared_table(const std::vector<PaperRow>& rows, std::size_t published,
                                         const std::vector<MeasuredColumn>& columns);

/// The same for programs: a row for each column and figure.
/// @param table such as "2"; @param problem what the columns are about.
void add_compared_rows(ReportTable& csv, const std::string& table, const std::string& problem,
                       const std::vector<PaperRow>& rows, std::size_t published,
                       const std::vector<MeasuredColumn>& columns);
/// Such a table without rows.
[[nodiscard]] ReportTable compared_csv();

/// Table 3, with the parameters of two planners beside it.
[[nodiscard]] ReportTable parameters_compared(const planning::CampaignPlanner& with_pmds,
                                              const planning::CampaignPlanner& without_pmds);

}  // namespace handway::tools
