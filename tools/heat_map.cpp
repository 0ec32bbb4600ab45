#include "campaign_report.h"
#include "handway/geometric/io/number_text.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace handway::tools {
namespace {

using planning::CampaignCell;

double median_time(const CampaignCell& cell) {
  return cell.runs.empty() ? std::numeric_limits<double>::quiet_NaN()
                           : planning::quantile_of(cell.times(), 0.5);
}

}  // namespace

report::HeatMap heat_map(const ParameterGrid& grid, std::span<const CampaignCell> cells) {
  report::HeatMap map{grid.x, grid.y, grid.x_values, grid.y_values, {}};
  for (const std::size_t planner : grid.planners) {
    const CampaignCell& cell = cells[planner];
    report::Tile tile{median_time(cell)};
    if (cell.solved() < cell.runs.size()) {
      const double share =
          static_cast<double>(cell.solved()) / static_cast<double>(cell.runs.size());
      tile.note = report::number_text(report::percent(share)) + " solved";
    }
    map.tiles.push_back(std::move(tile));
  }
  return map;
}

namespace {

using planning::Campaign;
using planning::CampaignPlanner;
using planning::ParameterTexts;

// Sorts numbers by their size, before words.
bool comes_first(const std::string& a, const std::string& b) {
  const std::optional<double> left = geometric::parse_number(a);
  const std::optional<double> right = geometric::parse_number(b);
  if (left && right) {
    return *left < *right;
  }
  return left.has_value() != right.has_value() ? left.has_value() : a < b;
}

std::vector<std::string> sorted(const std::set<std::string>& values) {
  std::vector<std::string> list(values.begin(), values.end());
  std::ranges::sort(list, comes_first);
  return list;
}

/// Entries that differ in parameters `x` and `y` alone, by their values.
using Sheet = std::map<std::pair<std::string, std::string>, std::size_t>;

std::vector<Sheet> sheets_of(const Campaign& campaign, const std::string& planner, std::size_t x,
                             std::size_t y) {
  std::map<ParameterTexts, Sheet> by_rest;
  for (std::size_t i = 0; i < campaign.planners.size(); ++i) {
    const CampaignPlanner& entry = campaign.planners[i];
    if (entry.planner == planner) {
      ParameterTexts rest = entry.parameters;
      rest[x].second.clear();
      rest[y].second.clear();
      by_rest[rest][{entry.parameters[x].second, entry.parameters[y].second}] = i;
    }
  }
  std::vector<Sheet> sheets;
  sheets.reserve(by_rest.size());
  for (auto& [rest, sheet] : by_rest) {
    sheets.push_back(std::move(sheet));
  }
  return sheets;
}

// Removes rows and columns that lack a combination, the emptiest first.
std::optional<ParameterGrid> grid_of(const Sheet& sheet) {
  std::set<std::string> xs;
  std::set<std::string> ys;
  for (const auto& [values, index] : sheet) {
    xs.insert(values.first);
    ys.insert(values.second);
  }
  const auto count_x = [&](const std::string& x) {
    return std::ranges::count_if(ys, [&](const std::string& y) { return sheet.contains({x, y}); });
  };
  const auto count_y = [&](const std::string& y) {
    return std::ranges::count_if(xs, [&](const std::string& x) { return sheet.contains({x, y}); });
  };
  while (xs.size() > 1 && ys.size() > 1) {
    const std::string x = *std::ranges::min_element(xs, {}, count_x);
    const std::string y = *std::ranges::min_element(ys, {}, count_y);
    const double full_x = static_cast<double>(count_x(x)) / static_cast<double>(ys.size());
    const double full_y = static_cast<double>(count_y(y)) / static_cast<double>(xs.size());
    if (full_x == 1.0 && full_y == 1.0) {
      break;
    }
    if (full_x <= full_y) {
      xs.erase(x);
    } else {
      ys.erase(y);
    }
  }
  if (xs.size() < 2 || ys.size() < 2) {
    return std::nullopt;
  }
  ParameterGrid grid;
  grid.x_values = sorted(xs);
  grid.y_values = sorted(ys);
  for (const std::string& y : grid.y_values) {
    for (const std::string& x : grid.x_values) {
      grid.planners.push_back(sheet.at({x, y}));
    }
  }
  return grid;
}

}  // namespace

std::vector<ParameterGrid> parameter_grids(const Campaign& campaign) {
  std::vector<ParameterGrid> grids;
  std::set<std::string> seen;
  for (const CampaignPlanner& first : campaign.planners) {
    if (!seen.insert(first.planner).second) {
      continue;
    }
    for (std::size_t x = 0; x < first.parameters.size(); ++x) {
      for (std::size_t y = x + 1; y < first.parameters.size(); ++y) {
        for (const Sheet& sheet : sheets_of(campaign, first.planner, x, y)) {
          if (std::optional<ParameterGrid> grid = grid_of(sheet)) {
            grid->planner = first.planner;
            grid->x = first.parameters[x].first;
            grid->y = first.parameters[y].first;
            grids.push_back(std::move(*grid));
          }
        }
      }
    }
  }
  return grids;
}

report::Table heat_map_table(const Campaign& campaign, std::span<const ParameterGrid> grids,
                             std::span<const CampaignCell> cells) {
  report::Table table{{"problem", "planner", "label", "x", "x_value", "y", "y_value", "runs",
                       "solved", "median_time_s"}};
  for (std::size_t begin = 0; begin < cells.size(); begin += campaign.planners.size()) {
    for (const ParameterGrid& grid : grids) {
      for (std::size_t i = 0; i < grid.planners.size(); ++i) {
        const CampaignCell& cell = cells[begin + grid.planners[i]];
        table.rows.push_back({campaign.problems[static_cast<std::size_t>(cell.problem)].name,
                              grid.planner, campaign.planners[grid.planners[i]].label, grid.x,
                              grid.x_values[i % grid.x_values.size()], grid.y,
                              grid.y_values[i / grid.x_values.size()], cell.runs.size(),
                              cell.solved(), report::seconds(median_time(cell))});
      }
    }
  }
  return table;
}

}  // namespace handway::tools
