#pragma once

#include "campaign_command.h"
#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/report/document/document.h"

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace handway::tools {

/// A figure of the paper's, made again.
struct ReproducedFigure {
  int number = 0;  ///< In the paper.
  std::string caption;
  std::string text;                    ///< Description of its data; may be empty.
  std::vector<report::Part> drawings;  ///< Figures and pictures.
  std::optional<report::Table> table;  ///< Published figures beside the measured ones, if any.
  std::string problem;                 ///< Reason of missing parts; may be empty.
};

/// Figures available: 7 to 10 of hand postures, 11 to 13 of the planner, 14 to 17 of paths.
[[nodiscard]] std::set<int> reproducible_figures();

/// Makes `figures` in their order: see reproduce_planner_figures() and reproduce_films().
/// @param time_limit_s of each plan. @param shipped_only leaves out recordings of people.
/// @throws InputError if a file can't be written or a scene can't be read.
[[nodiscard]] std::vector<ReproducedFigure> reproduce_figures(
    const std::set<int>& figures, const planning::PluginManager& plugins, double time_limit_s,
    bool shipped_only, const std::filesystem::path& folder);

/// A campaign of the reproduction, carried out.
struct ReproducedCampaign {
  int table = 0;  ///< Table of the paper: 2 or 4.
  planning::Campaign campaign;
  CampaignOutcome outcome;
};

/// Writes report.md, report.html and report.csv: the paper's tables and figures with ours.
/// @param tables some of 2, 3 and 4. Table 3 needs the campaign of Table 2, carried out or not.
/// @param preview_s seconds that a preview took; nothing: it is no preview.
/// @throws InputError if that fails.
void write_reproduce_report(const std::set<int>& tables,
                            const std::vector<ReproducedCampaign>& campaigns,
                            const std::vector<ReproducedFigure>& figures,
                            std::optional<double> preview_s, const std::filesystem::path& folder);

}  // namespace handway::tools
