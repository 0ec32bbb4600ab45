#pragma once

#include "campaign_command.h"
#include "handway/planning/campaigns/campaign.h"
#include "reproduce_figures.h"

#include <filesystem>
#include <set>
#include <vector>

namespace handway::tools {

/// A campaign of the reproduction, once it is carried out.
struct ReproducedCampaign {
  int table = 0;  ///< Of the paper: 2 or 4.
  planning::Campaign campaign;
  CampaignOutcome outcome;
};

/// Writes report.md, report.html and report.csv: the paper's tables and figures with ours.
/// @param tables which of 2, 3 and 4. Table 3 needs the campaign of Table 2, carried out or not.
/// @throws InputError if that can't be done.
void write_reproduce_report(const std::set<int>& tables,
                            const std::vector<ReproducedCampaign>& campaigns,
                            const std::vector<ReproducedFigure>& figures, bool quick,
                            const std::filesystem::path& folder);

}  // namespace handway::tools
