#include "campaign_tables.h"

#include "number_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace handway::tools {
namespace {

using planning::Campaign;
using planning::CampaignCell;
using planning::RunMeasure;
using planning::RunRecord;

std::vector<std::string> names(const Campaign& campaign, int problem, int planner) {
  return {campaign.problems[static_cast<std::size_t>(problem)].name,
          campaign.planners[static_cast<std::size_t>(planner)].label};
}

std::string whole(std::uint64_t value) { return fmt::format("{}", value); }

}  // namespace

ReportTable runs_table(const Campaign& campaign, std::span<const RunRecord> records) {
  ReportTable table;
  table.columns = {"problem",
                   "planner",
                   "seed",
                   "solved",
                   "status",
                   "time_s",
                   "smoothing_s",
                   "sampling_s",
                   "connection_s",
                   "samples",
                   "nodes",
                   "edges",
                   "passes",
                   "max_trials",
                   "final_rho_a",
                   "nodes_per_pmds",
                   "node_checks",
                   "edge_checks",
                   "edges_tested",
                   "path_nodes",
                   "path_length",
                   "resolution_mm",
                   "min_clearance_mm",
                   "certificate_checks"};
  for (const RunRecord& run : records) {
    std::vector<std::string> row = names(campaign, run.spec.problem, run.spec.planner);
    const std::vector<std::string> rest = {whole(run.spec.seed),
                                           run.solved ? "true" : "false",
                                           run.status,
                                           seconds_field(run.time_s),
                                           seconds_field(run.smoothing_s),
                                           seconds_field(run.sampling_s),
                                           seconds_field(run.connection_s),
                                           whole(run.samples),
                                           whole(run.nodes),
                                           whole(run.edges),
                                           whole(run.passes),
                                           whole(run.max_trials),
                                           number_field(run.final_rho_a),
                                           fmt::format("{}", fmt::join(run.nodes_per_pmds, " ")),
                                           whole(run.node_checks),
                                           whole(run.edge_checks),
                                           whole(run.edges_tested),
                                           whole(run.path_nodes),
                                           number_field(run.path_length),
                                           number_field(run.resolution_mm),
                                           number_field(run.min_clearance_mm),
                                           whole(run.certificate_checks)};
    row.insert(row.end(), rest.begin(), rest.end());
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable summary_table(const Campaign& campaign, std::span<const CampaignCell> cells) {
  ReportTable table;
  table.columns = {"problem", "planner",       "runs",          "solved",
                   "success", "success_lower", "success_upper", "median_time_of_all_s"};
  for (const RunMeasure& measure : planning::run_measures()) {
    for (const char* what : {"mean", "mean_lower", "mean_upper", "deviation", "min", "quartile_1",
                             "median", "quartile_3", "p95", "max"}) {
      table.columns.push_back(fmt::format("{}_{}", measure.key, what));
    }
  }
  for (const CampaignCell& cell : cells) {
    std::vector<std::string> row = names(campaign, cell.problem, cell.planner);
    const planning::Interval success = planning::wilson_interval(cell.solved(), cell.runs.size());
    row.push_back(whole(cell.runs.size()));
    row.push_back(whole(cell.solved()));
    row.push_back(
        number_field(static_cast<double>(cell.solved()) / static_cast<double>(cell.runs.size())));
    row.push_back(number_field(success.lower));
    row.push_back(number_field(success.upper));
    row.push_back(seconds_field(planning::quantile_of(cell.times(), 0.5)));
    for (const RunMeasure& measure : planning::run_measures()) {
      const std::vector<double> values = cell.of_solved(measure);
      const planning::Interval mean = planning::mean_interval(values);
      for (const double value :
           {planning::mean_of(values), mean.lower, mean.upper, planning::deviation_of(values),
            planning::quantile_of(values, 0.0), planning::quantile_of(values, 0.25),
            planning::quantile_of(values, 0.5), planning::quantile_of(values, 0.75),
            planning::quantile_of(values, 0.95), planning::quantile_of(values, 1.0)}) {
        row.push_back(number_field(value));
      }
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

ReportTable ecdf_table(const Campaign& campaign, std::span<const CampaignCell> cells) {
  ReportTable table{{"problem", "planner", "time_s", "share"}, {}};
  for (const CampaignCell& cell : cells) {
    for (const planning::EcdfStep& step : planning::ecdf_of(cell.times())) {
      std::vector<std::string> row = names(campaign, cell.problem, cell.planner);
      row.push_back(seconds_field(step.value));
      row.push_back(number_field(step.share));
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

ReportTable box_plot_table(const Campaign& campaign, std::span<const CampaignCell> cells) {
  ReportTable table{{"problem", "planner", "measure", "lower_whisker", "quartile_1", "median",
                     "quartile_3", "upper_whisker", "outliers"},
                    {}};
  for (const CampaignCell& cell : cells) {
    for (const RunMeasure& measure : planning::run_measures()) {
      const std::vector<double> values = cell.of_solved(measure);
      if (values.empty()) {
        continue;
      }
      const planning::BoxPlot box = planning::box_plot_of(values);
      std::vector<std::string> row = names(campaign, cell.problem, cell.planner);
      row.push_back(measure.key);
      for (const double value : {box.lower_whisker, box.lower_quartile, box.median,
                                 box.upper_quartile, box.upper_whisker}) {
        row.push_back(number_field(value));
      }
      row.push_back(fmt::format("{}", fmt::join(box.outliers, " ")));
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

ReportTable comparison_table(const Campaign& campaign,
                             std::span<const planning::CampaignComparison> comparisons) {
  ReportTable table{{"problem", "first", "second", "u", "first_is_faster", "p", "p_holm", "method"},
                    {}};
  for (const planning::CampaignComparison& comparison : comparisons) {
    std::vector<std::string> row = names(campaign, comparison.problem, comparison.first);
    row.push_back(campaign.planners[static_cast<std::size_t>(comparison.second)].label);
    for (const double value :
         {comparison.test.u, comparison.test.effect, comparison.test.p, comparison.adjusted_p}) {
      row.push_back(number_field(value));
    }
    row.push_back(comparison.test.exact ? "exact" : "normal");
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace handway::tools
