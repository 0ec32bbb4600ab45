#include "reproduce_tables.h"

#include "number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace handway::tools {
namespace {

using planning::CampaignCell;
using planning::Interval;

// Over the runs that found a path, where there is such a number.
std::vector<double> values_of(const PaperRow& row, const CampaignCell& cell) {
  std::vector<double> values = cell.of_solved({"", "", row.value});
  std::erase_if(values, [](double value) { return std::isnan(value); });
  return values;
}

std::string mean_text(const std::vector<double>& values) {
  const Interval interval = planning::mean_interval(values);
  if (std::isnan(interval.lower)) {
    return number_text(planning::mean_of(values));
  }
  return fmt::format("{} ({} to {})", number_text(planning::mean_of(values)),
                     number_text(interval.lower), number_text(interval.upper));
}

std::string success_text(const CampaignCell& cell) {
  const Interval interval = planning::wilson_interval(cell.solved(), cell.runs.size());
  return fmt::format(
      "{} ({:.1f} to {:.1f})",
      percent_text(static_cast<double>(cell.solved()) / static_cast<double>(cell.runs.size())),
      100.0 * interval.lower, 100.0 * interval.upper);
}

std::string times_faster(double published, const CampaignCell& cell, const PaperRow& time) {
  const double mean = planning::mean_of(values_of(time, cell));
  return mean > 0.0 ? number_text(published / mean) : "-";
}

const std::string& parameter_of(const planning::CampaignPlanner& planner, const std::string& key) {
  static const std::string kNone = "-";
  const auto found =
      std::ranges::find(planner.parameters, key, &planning::ParameterTexts::value_type::first);
  return found == planner.parameters.end() ? kNone : found->second;
}

}  // namespace

ReportTable compared_table(const std::vector<PaperRow>& rows, std::size_t published,
                           const std::vector<MeasuredColumn>& columns) {
  ReportTable table{{"", "published"}, {{"Runs", "-"}, {"Solved", "-"}}};
  for (const MeasuredColumn& column : columns) {
    table.columns.push_back(column.label);
    table.rows[0].push_back(fmt::format("{}", column.cell.runs.size()));
    table.rows[1].push_back(success_text(column.cell));
  }
  for (const PaperRow& row : rows) {
    std::vector<std::string> cells = {row.label, number_text(row.published[published])};
    for (const MeasuredColumn& column : columns) {
      cells.push_back(mean_text(values_of(row, column.cell)));
    }
    const bool applies = std::any_of(cells.begin() + 1, cells.end(),
                                     [](const std::string& cell) { return cell != "-"; });
    if (applies) {
      table.rows.push_back(std::move(cells));
    }
  }
  std::vector<std::string> ratio = {"Published time / our mean time", "1"};
  std::vector<std::string> median = {"Median time of all runs [s]", "-"};
  for (const MeasuredColumn& column : columns) {
    ratio.push_back(times_faster(rows.front().published[published], column.cell, rows.front()));
    median.push_back(number_text(planning::quantile_of(column.cell.times(), 0.5)));
  }
  table.rows.push_back(std::move(median));
  table.rows.push_back(std::move(ratio));
  return table;
}

ReportTable compared_csv() {
  return {{"table", "problem", "column", "runs", "solved", "figure", "published", "mean",
           "mean_lower", "mean_upper", "median"},
          {}};
}

void add_compared_rows(ReportTable& csv, const std::string& table, const std::string& problem,
                       const std::vector<PaperRow>& rows, std::size_t published,
                       const std::vector<MeasuredColumn>& columns) {
  for (const MeasuredColumn& column : columns) {
    for (const PaperRow& row : rows) {
      const std::vector<double> values = values_of(row, column.cell);
      const Interval interval = planning::mean_interval(values);
      csv.rows.push_back({table, problem, column.label, fmt::format("{}", column.cell.runs.size()),
                          fmt::format("{}", column.cell.solved()), row.label,
                          number_field(row.published[published]),
                          number_field(planning::mean_of(values)), number_field(interval.lower),
                          number_field(interval.upper),
                          number_field(planning::quantile_of(values, 0.5))});
    }
  }
}

ReportTable parameters_compared(const planning::CampaignPlanner& with_pmds,
                                const planning::CampaignPlanner& without_pmds) {
  ReportTable table{{"Parameter", "published, PMDs", "ours, " + with_pmds.planner,
                     "published, no PMDs", "ours, " + without_pmds.planner},
                    {}};
  for (const PaperParameter& parameter : paper_table_3()) {
    table.rows.push_back({parameter.label, parameter.with_pmds,
                          parameter_of(with_pmds, parameter.key), parameter.without_pmds,
                          parameter_of(without_pmds, parameter.key)});
  }
  return table;
}

}  // namespace handway::tools
