#include "handway/planning/campaigns/campaign_summary.h"

#include <algorithm>
#include <limits>

namespace handway::planning {

const std::vector<RunMeasure>& run_measures() {
  static const std::vector<RunMeasure> kMeasures = {
      {"time_s", "Time to find a solution [s]", [](const RunRecord& r) { return r.time_s; }},
      {"smoothing_s", "Smoothing time [s]", [](const RunRecord& r) { return r.smoothing_s; }},
      {"samples", "Samples", [](const RunRecord& r) { return static_cast<double>(r.samples); }},
      {"nodes", "Nodes of the roadmap or trees",
       [](const RunRecord& r) { return static_cast<double>(r.nodes); }},
      {"checks", "Configurations checked",
       [](const RunRecord& r) { return static_cast<double>(r.node_checks + r.edge_checks); }},
      {"path_nodes", "Nodes in the solution path",
       [](const RunRecord& r) { return static_cast<double>(r.path_nodes); }},
      {"path_length", "Length of the path (normalised joints)",
       [](const RunRecord& r) { return r.path_length; }},
      {"min_clearance_mm", "Smallest clearance [mm]",
       [](const RunRecord& r) { return r.min_clearance_mm; }},
  };
  return kMeasures;
}

std::size_t CampaignCell::solved() const {
  return static_cast<std::size_t>(std::ranges::count_if(runs, &RunRecord::solved));
}

std::vector<double> CampaignCell::of_solved(const RunMeasure& measure) const {
  std::vector<double> values;
  for (const RunRecord& run : runs) {
    if (run.solved) {
      values.push_back(measure.value(run));
    }
  }
  return values;
}

std::vector<double> CampaignCell::times() const {
  std::vector<double> values;
  values.reserve(runs.size());
  for (const RunRecord& run : runs) {
    values.push_back(run.solved ? run.time_s : std::numeric_limits<double>::infinity());
  }
  return values;
}

std::vector<CampaignCell> campaign_cells(const Campaign& campaign,
                                         std::span<const RunRecord> records) {
  std::vector<CampaignCell> cells;
  for (int problem = 0; problem < static_cast<int>(campaign.problems.size()); ++problem) {
    for (int planner = 0; planner < static_cast<int>(campaign.planners.size()); ++planner) {
      cells.push_back({problem, planner, {}});
    }
  }
  for (const RunRecord& record : records) {
    const std::size_t cell =
        static_cast<std::size_t>(record.spec.problem) * campaign.planners.size() +
        static_cast<std::size_t>(record.spec.planner);
    cells[cell].runs.push_back(record);
  }
  return cells;
}

std::vector<CampaignComparison> compare_planners(std::span<const CampaignCell> cells) {
  std::vector<CampaignComparison> all;
  for (std::size_t begin = 0, end = 0; begin < cells.size(); begin = end) {
    while (end < cells.size() && cells[end].problem == cells[begin].problem) {
      ++end;
    }
    std::vector<CampaignComparison> comparisons;
    std::vector<double> p;
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t j = i + 1; j < end; ++j) {
        if (cells[i].runs.empty() || cells[j].runs.empty()) {
          continue;
        }
        comparisons.push_back({cells[i].problem, cells[i].planner, cells[j].planner,
                               mann_whitney(cells[i].times(), cells[j].times()), 1.0});
        p.push_back(comparisons.back().test.p);
      }
    }
    const std::vector<double> adjusted = holm_adjusted(p);
    for (std::size_t i = 0; i < comparisons.size(); ++i) {
      comparisons[i].adjusted_p = adjusted[i];
    }
    all.insert(all.end(), comparisons.begin(), comparisons.end());
  }
  return all;
}

}  // namespace handway::planning
