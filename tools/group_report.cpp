#include "group_report.h"

#include "campaign_report.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/campaigns/campaign_groups.h"
#include "left_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace handway::tools {
namespace {

using planning::CampaignGroup;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Column of the tables, after tag and planner.
struct GroupColumn {
  const char* key;  ///< In files.
  report::Column column;
  std::function<report::Cell(const CampaignGroup&)> cell;
  bool is_optional = false;  ///< Left out of a table without any value.
};

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? kNone : static_cast<double>(part) / static_cast<double>(whole);
}

double median(const std::vector<double>& values) {
  return values.empty() ? kNone : planning::quantile_of(values, 0.5);
}

// Median over the runs that found a path.
double median_of(const CampaignGroup& group, std::string_view key) {
  const auto& measures = planning::run_measures();
  return median(
      group.cell.of_solved(*std::ranges::find(measures, key, &planning::RunMeasure::key)));
}

report::Number in_milliseconds(double seconds) {
  return {.value = 1e3 * seconds, .digits = report::Digits::kThree};
}

report::Number three_digits(double value) {
  return {.value = value, .digits = report::Digits::kThree};
}

report::Number processor_quantile(const CampaignGroup& group, double p) {
  const std::vector<double> times = group.processor_times();
  return in_milliseconds(times.empty() ? kNone : planning::quantile_of(times, p));
}

std::vector<GroupColumn> group_columns() {
  const auto measure = [](const char* key, report::Column column, bool is_optional = false) {
    return GroupColumn{key, std::move(column),
                       [key](const CampaignGroup& group) -> report::Cell {
                         return three_digits(median_of(group, key));
                       },
                       is_optional};
  };
  return {
      {"problems", "problems", [](const auto& group) { return report::Cell(group.problems); }},
      {"runs", "runs", [](const auto& group) { return report::Cell(group.cell.runs.size()); }},
      {"solved",
       {"solved", "%"},
       [](const auto& group) { return report::Cell(success(group.cell)); }},
      {"certified",
       {"certified", "%"},
       [](const auto& group) {
         return report::Cell(report::percent(share(group.certified(), group.cell.solved())));
       }},
      {"valid",
       {"valid by FCL", "%"},
       [](const auto& group) {
         return report::Cell(report::percent(share(group.valid(), group.checked())));
       },
       true},
      {"cpu_median_ms",
       {"time", "ms"},
       [](const auto& group) { return report::Cell(processor_quantile(group, 0.5)); }},
      {"cpu_p95_ms",
       {"95 %", "ms"},
       [](const auto& group) { return report::Cell(processor_quantile(group, 0.95)); }},
      measure("l2_length", {"L2", "rad"}),
      measure("path_length", "length"),
      {"length_ratio", "to first",
       [](const auto& group) {
         return report::Cell(report::fixed(median(group.length_ratios), 2));
       }},
      measure("min_clearance_mm", {"clearance", "mm"}, true),
      measure("to_subspace", "to PMDs", true),
      measure("hand_sparc", "SPARC hand", true),
      measure("palm_sparc", "SPARC palm", true),
      measure("arm_deviation", "arm deviation", true),
  };
}

bool has_values(const GroupColumn& column, std::span<const CampaignGroup> groups) {
  return std::ranges::any_of(
      groups, [&](const CampaignGroup& group) { return !column.cell(group).field().empty(); });
}

/// A campaign and its records, with the paths of other planners as if they were runs.
struct WithOthers {
  planning::Campaign campaign;
  std::vector<planning::RunRecord> records;
};

WithOthers with_others(const CampaignOutcome& outcome) {
  WithOthers all{outcome.campaign, outcome.records};
  const int count = static_cast<int>(all.campaign.planners.size());
  for (const std::string& planner : outcome.others.planners) {
    all.campaign.planners.push_back({planner + " (its paths)", "", {}});
  }
  for (planning::RunRecord record : outcome.others.records) {
    record.spec.planner += count;
    all.records.push_back(std::move(record));
  }
  return all;
}

std::vector<report::Cell> row_of(const planning::Campaign& campaign, const CampaignGroup& group,
                                 std::span<const GroupColumn> columns) {
  std::vector<report::Cell> row;
  if (!group.key.empty()) {
    row.emplace_back(group.value);
  }
  row.emplace_back(campaign.planners[static_cast<std::size_t>(group.cell.planner)].label);
  for (const GroupColumn& column : columns) {
    row.push_back(column.cell(group));
  }
  return row;
}

// The table of groups of one key.
report::Table table_of(const planning::Campaign& campaign, std::span<const CampaignGroup> groups) {
  std::vector<GroupColumn> columns = group_columns();
  std::erase_if(columns, [&](const GroupColumn& column) {
    return column.is_optional && !has_values(column, groups);
  });
  report::Table table;
  if (const std::string& key = groups.front().key; !key.empty()) {
    table.columns.emplace_back(key);
  }
  table.columns.emplace_back("Planner");
  for (const GroupColumn& column : columns) {
    table.columns.push_back(column.column);
  }
  for (const CampaignGroup& group : groups) {
    table.rows.push_back(row_of(campaign, group, columns));
  }
  return table;
}

}  // namespace

report::Document group_tables(const CampaignOutcome& outcome) {
  const WithOthers all = with_others(outcome);
  const std::vector<CampaignGroup> groups =
      planning::campaign_groups(all.campaign, planning::campaign_cells(all.campaign, all.records));
  report::Document document;
  for (auto begin = groups.begin(); begin != groups.end();) {
    const auto end = std::find_if(
        begin, groups.end(), [&](const CampaignGroup& group) { return group.key != begin->key; });
    document.emplace_back(report::Heading{
        2, begin->key.empty() ? std::string("All problems") : fmt::format("By {}", begin->key)});
    document.emplace_back(table_of(all.campaign, std::span(begin, end)));
    begin = end;
  }
  return document;
}

report::Table group_table(const CampaignOutcome& outcome) {
  const WithOthers all = with_others(outcome);
  const std::vector<GroupColumn> columns = group_columns();
  report::Table table{{"tag", "value", "planner"}, {}};
  for (const GroupColumn& column : columns) {
    table.columns.emplace_back(column.key);
  }
  for (const CampaignGroup& group : planning::campaign_groups(
           all.campaign, planning::campaign_cells(all.campaign, all.records))) {
    std::vector<report::Cell> row = {
        group.key, group.value,
        all.campaign.planners[static_cast<std::size_t>(group.cell.planner)].label};
    for (const GroupColumn& column : columns) {
      row.push_back(column.cell(group));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

report::Document left_out_tables(const CampaignOutcome& outcome) {
  report::Document document;
  if (!outcome.left_out.empty()) {
    report::Table table{{"Problems left out", "reason"}, {}};
    for (const LeftOut& group : grouped(outcome.left_out)) {
      table.rows.push_back({group.problems, group.reason});
    }
    document.emplace_back(std::move(table));
  }
  if (!outcome.others.skipped.empty()) {
    report::Table table{{"Paths not checked"}, {}};
    for (const std::string& reason : outcome.others.skipped) {
      table.rows.push_back({reason});
    }
    document.emplace_back(std::move(table));
  }
  return document;
}

report::Table other_paths_table(const CampaignOutcome& outcome) {
  report::Table table{{"problem", "planner", "seed", "valid", "fault", "time_s", "path_nodes",
                       "l2_length", "path_length"},
                      {}};
  for (const planning::RunRecord& record : outcome.others.records) {
    table.rows.push_back(
        {outcome.campaign.problems[static_cast<std::size_t>(record.spec.problem)].name,
         outcome.others.planners[static_cast<std::size_t>(record.spec.planner)], record.spec.seed,
         record.fault.empty() ? "true" : "false", record.fault, report::seconds(record.time_s),
         record.path_nodes, record.l2_length, record.path_length});
  }
  return table;
}

}  // namespace handway::tools
