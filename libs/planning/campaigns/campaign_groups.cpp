#include "handway/planning/campaigns/campaign_groups.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace handway::planning {

std::size_t CampaignGroup::certified() const {
  return static_cast<std::size_t>(std::ranges::count_if(
      cell.runs, [](const RunRecord& run) { return run.solved && run.resolution > 0.0; }));
}

std::size_t CampaignGroup::checked() const {
  return static_cast<std::size_t>(std::ranges::count_if(cell.runs, &RunRecord::is_checked));
}

std::size_t CampaignGroup::valid() const {
  return static_cast<std::size_t>(std::ranges::count_if(
      cell.runs, [](const RunRecord& run) { return run.is_checked && run.fault.empty(); }));
}

std::vector<double> CampaignGroup::processor_times() const {
  std::vector<double> values;
  for (const RunRecord& run : cell.runs) {
    const double time = run.solved ? run.cpu_s : std::numeric_limits<double>::infinity();
    if (!std::isnan(time)) {
      values.push_back(time);
    }
  }
  return values;
}

namespace {

// Ratios of the lengths of runs of the same problem and seed that both found a path.
std::vector<double> length_ratios(std::span<const RunRecord> runs,
                                  std::span<const RunRecord> first) {
  std::map<std::pair<int, std::uint64_t>, double> lengths;
  for (const RunRecord& run : first) {
    if (run.solved && run.l2_length > 0.0) {
      lengths[{run.spec.problem, run.spec.seed}] = run.l2_length;
    }
  }
  std::vector<double> ratios;
  for (const RunRecord& run : runs) {
    if (const auto other = lengths.find({run.spec.problem, run.spec.seed});
        run.solved && other != lengths.end()) {
      ratios.push_back(run.l2_length / other->second);
    }
  }
  return ratios;
}

// Adds a group for each planner that has runs on the problems.
void add_groups(const Campaign& campaign, std::span<const CampaignCell> cells,
                const std::string& key, const std::string& value,
                std::vector<CampaignGroup>& groups) {
  const std::size_t begin = groups.size();
  for (int planner = 0; planner < static_cast<int>(campaign.planners.size()); ++planner) {
    CampaignGroup group{key, value, 0, {-1, planner, {}}, {}};
    for (const CampaignCell& cell : cells) {
      if (cell.planner != planner ||
          (!key.empty() &&
           campaign.problems[static_cast<std::size_t>(cell.problem)].tag(key) != value)) {
        continue;
      }
      const std::size_t before = group.cell.runs.size();
      std::ranges::copy_if(cell.runs, std::back_inserter(group.cell.runs),
                           [](const RunRecord& run) { return run.status != kRefused; });
      group.problems += group.cell.runs.size() > before ? 1 : 0;
    }
    if (group.problems > 0) {
      groups.push_back(std::move(group));
      groups.back().length_ratios = length_ratios(groups.back().cell.runs, groups[begin].cell.runs);
    }
  }
}

}  // namespace

std::vector<CampaignGroup> campaign_groups(const Campaign& campaign,
                                           std::span<const CampaignCell> cells) {
  std::vector<CampaignGroup> groups;
  std::vector<std::pair<std::string, std::set<std::string>>> keys;
  for (const CampaignProblem& problem : campaign.problems) {
    for (const auto& [key, value] : problem.tags) {
      const auto known = std::ranges::find(keys, key, &decltype(keys)::value_type::first);
      auto& entry = known == keys.end() ? keys.emplace_back(key, std::set<std::string>()) : *known;
      entry.second.insert(value);
    }
  }
  for (const auto& [key, values] : keys) {
    for (const std::string& value : values) {
      add_groups(campaign, cells, key, value, groups);
    }
  }
  if (!keys.empty()) {
    add_groups(campaign, cells, "", "", groups);
  }
  return groups;
}

}  // namespace handway::planning
