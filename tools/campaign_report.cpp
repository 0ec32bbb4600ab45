#include "campaign_report.h"

#include "campaign_command.h"
#include "campaign_progress.h"
#include "group_report.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/campaigns/campaign_statistics.h"
#include "handway/report/rendering/csv.h"
#include "handway/report/rendering/markdown.h"
#include "handway/report/rendering/report_files.h"
#include "machine.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace handway::tools {
namespace {

using planning::Campaign;
using planning::CampaignCell;
using planning::RunMeasure;
using planning::RunRecord;

const std::string& label_of(const Campaign& campaign, int planner) {
  return campaign.planners[static_cast<std::size_t>(planner)].label;
}

std::vector<report::Cell> names(const Campaign& campaign, int problem, int planner) {
  return {campaign.problems[static_cast<std::size_t>(problem)].name, label_of(campaign, planner)};
}

/// Column of the table of runs, after its problem and planner.
struct RunColumn {
  const char* name;
  report::Cell (*cell)(const RunRecord&);
};

constexpr std::array kRunColumns = std::to_array<RunColumn>({
    {"seed", [](const RunRecord& run) { return report::Cell(run.spec.seed); }},
    {"solved", [](const RunRecord& run) { return report::Cell(run.solved ? "true" : "false"); }},
    {"status", [](const RunRecord& run) { return report::Cell(run.status); }},
    {"time_s", [](const RunRecord& run) { return report::Cell(report::seconds(run.time_s)); }},
    {"smoothing_s",
     [](const RunRecord& run) { return report::Cell(report::seconds(run.smoothing_s)); }},
    {"sampling_s",
     [](const RunRecord& run) { return report::Cell(report::seconds(run.sampling_s)); }},
    {"connection_s",
     [](const RunRecord& run) { return report::Cell(report::seconds(run.connection_s)); }},
    {"samples", [](const RunRecord& run) { return report::Cell(run.samples); }},
    {"nodes", [](const RunRecord& run) { return report::Cell(run.nodes); }},
    {"edges", [](const RunRecord& run) { return report::Cell(run.edges); }},
    {"passes", [](const RunRecord& run) { return report::Cell(run.passes); }},
    {"max_trials", [](const RunRecord& run) { return report::Cell(run.max_trials); }},
    {"final_rho_a", [](const RunRecord& run) { return report::Cell(run.final_rho_a); }},
    {"nodes_per_pmds",
     [](const RunRecord&
            run) { return report::Cell(fmt::format("{}", fmt::join(run.nodes_per_pmds, " "))); }},
    {"node_checks", [](const RunRecord& run) { return report::Cell(run.node_checks); }},
    {"edge_checks", [](const RunRecord& run) { return report::Cell(run.edge_checks); }},
    {"edges_tested", [](const RunRecord& run) { return report::Cell(run.edges_tested); }},
    {"path_nodes", [](const RunRecord& run) { return report::Cell(run.path_nodes); }},
    {"path_length", [](const RunRecord& run) { return report::Cell(run.path_length); }},
    {"resolution_mm",
     [](const RunRecord& run) { return report::Cell(geometric::millimetres(run.resolution)); }},
    {"min_clearance_mm",
     [](const RunRecord& run) { return report::Cell(geometric::millimetres(run.min_clearance)); }},
    {"certificate_checks",
     [](const RunRecord& run) { return report::Cell(run.certificate_checks); }},
    {"cpu_s", [](const RunRecord& run) { return report::Cell(report::seconds(run.cpu_s)); }},
    {"l2_length", [](const RunRecord& run) { return report::Cell(run.l2_length); }},
    {"fault", [](const RunRecord& run) { return report::Cell(run.fault); }},
    {"to_subspace", [](const RunRecord& run) { return report::Cell(run.measures.to_subspace); }},
    {"hand_sparc", [](const RunRecord& run) { return report::Cell(run.measures.hand_sparc); }},
    {"palm_sparc", [](const RunRecord& run) { return report::Cell(run.measures.palm_sparc); }},
    {"arm_deviation",
     [](const RunRecord& run) { return report::Cell(run.measures.arm_deviation); }},
});

/// A row a run.
report::Table runs_table(const Campaign& campaign, std::span<const RunRecord> records) {
  report::Table table{{"problem", "planner"}, {}};
  for (const RunColumn& column : kRunColumns) {
    table.columns.emplace_back(column.name);
  }
  for (const RunRecord& run : records) {
    std::vector<report::Cell> row = names(campaign, run.spec.problem, run.spec.planner);
    for (const RunColumn& column : kRunColumns) {
      row.push_back(column.cell(run));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// A row for each problem and planner: success with its interval, and for each measure mean,
/// its interval, deviation, quartiles, least and most over the runs that found a path.
report::Table summary_table(const Campaign& campaign, std::span<const CampaignCell> cells) {
  report::Table table;
  table.columns = {"problem", "planner",       "runs",          "solved",
                   "success", "success_lower", "success_upper", "median_time_of_all_s"};
  for (const RunMeasure& measure : planning::run_measures()) {
    for (const char* what : {"mean", "mean_lower", "mean_upper", "deviation", "min", "quartile_1",
                             "median", "quartile_3", "p95", "max"}) {
      table.columns.emplace_back(fmt::format("{}_{}", measure.key, what));
    }
  }
  for (const CampaignCell& cell : cells) {
    std::vector<report::Cell> row = names(campaign, cell.problem, cell.planner);
    const planning::Interval success = planning::wilson_interval(cell.solved(), cell.runs.size());
    row.insert(
        row.end(),
        {cell.runs.size(), cell.solved(),
         static_cast<double>(cell.solved()) / static_cast<double>(cell.runs.size()), success.lower,
         success.upper, report::seconds(planning::quantile_of(cell.times(), 0.5))});
    for (const RunMeasure& measure : planning::run_measures()) {
      const std::vector<double> values = cell.of_solved(measure);
      const planning::Interval mean = planning::mean_interval(values);
      for (const double value :
           {planning::mean_of(values), mean.lower, mean.upper, planning::deviation_of(values),
            planning::quantile_of(values, 0.0), planning::quantile_of(values, 0.25),
            planning::quantile_of(values, 0.5), planning::quantile_of(values, 0.75),
            planning::quantile_of(values, 0.95), planning::quantile_of(values, 1.0)}) {
        row.emplace_back(value);
      }
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// A row for each step of the distribution of planning times.
report::Table ecdf_table(const Campaign& campaign, std::span<const CampaignCell> cells) {
  report::Table table{{"problem", "planner", "time_s", "share"}, {}};
  for (const CampaignCell& cell : cells) {
    for (const planning::EcdfStep& step : planning::ecdf_of(cell.times())) {
      std::vector<report::Cell> row = names(campaign, cell.problem, cell.planner);
      row.emplace_back(report::seconds(step.value));
      row.emplace_back(step.share);
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

/// A row for each problem, planner and measure: the values of a box plot.
report::Table box_plot_table(const Campaign& campaign, std::span<const CampaignCell> cells) {
  report::Table table{{"problem", "planner", "measure", "lower_whisker", "quartile_1", "median",
                       "quartile_3", "upper_whisker", "outliers"},
                      {}};
  for (const CampaignCell& cell : cells) {
    for (const RunMeasure& measure : planning::run_measures()) {
      const std::vector<double> values = cell.of_solved(measure);
      if (values.empty()) {
        continue;
      }
      const planning::BoxPlot box = planning::box_plot_of(values);
      std::vector<report::Cell> row = names(campaign, cell.problem, cell.planner);
      row.emplace_back(measure.key);
      for (const double value : {box.lower_whisker, box.lower_quartile, box.median,
                                 box.upper_quartile, box.upper_whisker}) {
        row.emplace_back(value);
      }
      row.emplace_back(fmt::format("{}", fmt::join(box.outliers, " ")));
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

/// A row for each pair of planners on a problem.
report::Table comparison_table(const Campaign& campaign,
                               std::span<const planning::CampaignComparison> comparisons) {
  report::Table table{
      {"problem", "first", "second", "u", "first_is_faster", "p", "p_holm", "method"}, {}};
  for (const planning::CampaignComparison& comparison : comparisons) {
    std::vector<report::Cell> row = names(campaign, comparison.problem, comparison.first);
    row.emplace_back(label_of(campaign, comparison.second));
    for (const double value :
         {comparison.test.u, comparison.test.effect, comparison.test.p, comparison.adjusted_p}) {
      row.emplace_back(value);
    }
    row.emplace_back(comparison.test.exact ? "exact" : "normal");
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// The share of runs that found a path over time.
report::XyPlot ecdf_plot(const Campaign& campaign, std::span<const CampaignCell> cells) {
  report::XyPlot plot{"",
                      {.title = "time", .unit = "s", .is_logarithmic = true},
                      {.title = "runs with a path", .unit = "%", .least = 0.0, .most = 100.0},
                      {}};
  for (const CampaignCell& cell : cells) {
    report::Series series{label_of(campaign, cell.planner), report::Mark::kSteps};
    for (const planning::EcdfStep& step : planning::ecdf_of(cell.times())) {
      if (series.x.empty()) {
        series.x.push_back(step.value);
        series.y.push_back(0.0);
      }
      series.x.push_back(step.value);
      series.y.push_back(100.0 * step.share);
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

/// Boxes of the times of runs that found a path.
report::BoxPlot time_boxes(const Campaign& campaign, std::span<const CampaignCell> cells) {
  report::BoxPlot plot{{.title = "time", .unit = "s", .is_logarithmic = true}, {}};
  for (const CampaignCell& cell : cells) {
    report::Box box{.label = label_of(campaign, cell.planner)};
    std::vector<double> times = cell.times();
    std::erase_if(times, [](double value) { return !std::isfinite(value); });
    if (!times.empty()) {
      planning::BoxPlot values = planning::box_plot_of(times);
      box = {std::move(box.label),  values.lower_whisker, values.lower_quartile,     values.median,
             values.upper_quartile, values.upper_whisker, std::move(values.outliers)};
    }
    plot.boxes.push_back(std::move(box));
  }
  return plot;
}

namespace fs = std::filesystem;
using planning::CampaignComparison;

constexpr std::size_t kMostShown = 30;  // problems with tags, each in a section of its own
constexpr const char* kGroupNote =
    "In the tables of groups, the time is the processor time of planning, smoothing and "
    "certifying; "
    "its quantiles are over all runs, and a run without a path counts as infinite (∞). "
    "\"Certified\": share of the paths with a certificate of clearance along their whole length. "
    "\"L2\" (rad, m) and \"length\" (joints normalised to [0, 1]) and the columns to their right "
    "are "
    "medians over the runs that found a path. \"To first\": median of the path's length (L2) "
    "divided by that of the group's first planner, for the same problem and seed.";
constexpr std::size_t kMostCompared = 6;  // planners, for a table of pairs people can read
constexpr std::size_t kMostDrawn = 14;    // planners, for curves people can tell apart

report::Table overview(const Campaign& campaign, std::span<const CampaignCell> cells) {
  report::Table table{{"Planner",
                       "runs",
                       "solved",
                       {"median", "s"},
                       {"mean", "s"},
                       {"95 %", "s"},
                       "samples",
                       "nodes",
                       "checks",
                       "path nodes",
                       "path length",
                       {"clearance", "mm"}}};
  for (const CampaignCell& cell : cells) {
    std::vector<report::Cell> row = {label_of(campaign, cell.planner), cell.runs.size()};
    if (cell.runs.empty()) {
      row.resize(table.columns.size(), report::Number{});
      table.rows.push_back(std::move(row));
      continue;
    }
    const std::vector<double> times = cell.times();
    const auto mean = [&](const char* key) {
      const auto& measures = planning::run_measures();
      const auto measure = std::ranges::find(measures, key, &planning::RunMeasure::key);
      return planning::mean_of(cell.of_solved(*measure));
    };
    row.insert(row.end(), {success(cell), planning::quantile_of(times, 0.5), mean("time_s"),
                           planning::quantile_of(times, 0.95)});
    for (const char* key :
         {"samples", "nodes", "checks", "path_nodes", "path_length", "min_clearance_mm"}) {
      row.emplace_back(mean(key));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

report::Number p_value(double p) {
  constexpr double kLeast = 1e-4;
  report::Number number = report::fixed(std::max(p, kLeast), 4);
  number.prefix = p < kLeast ? "< " : "";
  return number;
}

report::Table pairs(const Campaign& campaign, std::span<const CampaignComparison> comparisons,
                    int problem) {
  report::Table table{{"Planners", "first is faster", "p", "p (Holm)"}};
  for (const CampaignComparison& comparison : comparisons) {
    if (comparison.problem == problem) {
      table.rows.push_back({fmt::format("{} : {}", label_of(campaign, comparison.first),
                                        label_of(campaign, comparison.second)),
                            report::percent(comparison.test.effect), p_value(comparison.test.p),
                            p_value(comparison.adjusted_p)});
    }
  }
  return table;
}

// Returns the reasons of runs without a path, if there are some.
report::Table failures(const Campaign& campaign, std::span<const CampaignCell> cells) {
  report::Table table{{"Planner", "status", "runs", "example"}};
  for (const CampaignCell& cell : cells) {
    std::set<std::string> listed;
    for (const planning::RunRecord& run : cell.runs) {
      if (!run.solved && listed.insert(run.status).second) {
        const auto count = std::ranges::count(cell.runs, run.status, &planning::RunRecord::status);
        table.rows.push_back({label_of(campaign, cell.planner), run.status, count, run.reason});
      }
    }
  }
  return table;
}

// Returns the runs of each planner on all problems.
std::vector<CampaignCell> cells_of_planners(const Campaign& campaign,
                                            std::span<const CampaignCell> cells) {
  std::vector<CampaignCell> merged(campaign.planners.size());
  for (const CampaignCell& cell : cells) {
    CampaignCell& of_planner = merged[static_cast<std::size_t>(cell.planner)];
    of_planner.planner = cell.planner;
    of_planner.runs.insert(of_planner.runs.end(), cell.runs.begin(), cell.runs.end());
  }
  return merged;
}

// The cells for drawings of curves and boxes: if there are many, those that no heat map
// shows.
std::vector<CampaignCell> curves_of(std::span<const CampaignCell> cells,
                                    std::span<const ParameterGrid> grids) {
  std::vector<CampaignCell> drawn(cells.begin(), cells.end());
  if (cells.size() > kMostDrawn) {
    std::erase_if(drawn, [&](const CampaignCell& cell) {
      return std::ranges::any_of(grids, [&](const ParameterGrid& grid) {
        return std::ranges::count(grid.planners, static_cast<std::size_t>(cell.planner)) != 0;
      });
    });
  }
  return drawn;
}

void add_problem(report::Document& document, const Campaign& campaign,
                 std::span<const CampaignCell> cells,
                 std::span<const CampaignComparison> comparisons,
                 std::span<const ParameterGrid> grids) {
  const int problem = cells.front().problem;
  document.emplace_back(
      report::Heading{2, campaign.problems[static_cast<std::size_t>(problem)].name});
  document.push_back(overview(campaign, cells));
  if (report::Table table = failures(campaign, cells); !table.rows.empty()) {
    document.emplace_back(report::Paragraph{"Runs without a path:"});
    document.push_back(std::move(table));
  }
  for (const ParameterGrid& grid : grids) {
    document.push_back(
        report::Figure{fmt::format("{}: median time by {} and {}", grid.planner, grid.x, grid.y),
                       {heat_map(grid, cells)},
                       1,
                       "heatmaps.csv"});
  }
  const std::vector<CampaignCell> drawn = curves_of(cells, grids);
  if (drawn.empty()) {
    return;
  }
  document.emplace_back(report::Figure{
      "Share of runs solved within a time", {ecdf_plot(campaign, drawn)}, 1, "ecdf.csv"});
  document.emplace_back(report::Figure{
      "Times of the runs that found a path: quartiles, whiskers up to 1.5 box lengths, outliers",
      {time_boxes(campaign, drawn)},
      1,
      "boxplot.csv"});
  if (cells.size() > 1 && cells.size() <= kMostCompared) {
    document.push_back(pairs(campaign, comparisons, problem));
  }
}

report::Document campaign_document(const Campaign& campaign, const CampaignOutcome& outcome,
                                   std::span<const CampaignCell> cells,
                                   std::span<const CampaignComparison> comparisons) {
  report::Document document;
  document.emplace_back(report::Heading{1, campaign.name});
  if (!campaign.description.empty()) {
    document.emplace_back(report::Paragraph{campaign.description});
  }
  if (!outcome.complete) {
    document.emplace_back(report::Paragraph{fmt::format(
        "Incomplete: {} of {} runs are done.", outcome.records.size(), campaign.run_count())});
  }
  document.push_back(machine_table(outcome));
  document.emplace_back(report::Paragraph{fmt::format(
      "Every run has {} thread(s) and a time limit of {:g} s. In brackets: Wilson's 95 % interval "
      "of the success rate. The median and the 95 % quantile of the time are over all runs; a run "
      "without a path counts as infinite (∞). All other figures are means over the runs that found "
      "a path. \"First is faster\": share of the pairs of one run of each planner in which the "
      "first planner is faster. p: two-sided Mann-Whitney test, then adjusted by Holm for all "
      "pairs of a problem.",
      campaign.threads, campaign.time_limit_s)});
  const auto append = [&](report::Document parts) {
    std::ranges::move(parts, std::back_inserter(document));
  };
  append(left_out_tables(outcome));
  report::Document groups = group_tables(outcome);
  const bool in_groups_only = !groups.empty() && campaign.problems.size() > kMostShown;
  if (!groups.empty()) {
    document.emplace_back(report::Paragraph{kGroupNote});
    append(std::move(groups));
  }
  if (in_groups_only) {
    document.emplace_back(report::Paragraph{
        "The figures of each problem are in `summary.csv`, and each run in `runs.csv`."});
    if (report::Table table = failures(campaign, cells_of_planners(campaign, cells));
        !table.rows.empty()) {
      document.emplace_back(report::Paragraph{"Runs without a path:"});
      document.push_back(std::move(table));
    }
    cells = {};
  }
  const std::vector<ParameterGrid> grids = parameter_grids(campaign);
  for (std::size_t begin = 0; begin < cells.size(); begin += campaign.planners.size()) {
    add_problem(document, campaign, cells.subspan(begin, campaign.planners.size()), comparisons,
                grids);
  }
  document.emplace_back(report::Heading{2, "Parameters"});
  document.push_back(parameter_table(campaign));
  return document;
}

// For file names: letters, digits, dots, hyphens and underscores of `text`.
std::string file_name_of(const std::string& text) {
  std::string name = text;
  std::ranges::replace_if(
      name,
      [](unsigned char c) { return std::isalnum(c) == 0 && c != '.' && c != '-' && c != '_'; },
      '_');
  return name;
}

}  // namespace

report::Estimate success(const CampaignCell& cell) {
  const planning::Interval interval = planning::wilson_interval(cell.solved(), cell.runs.size());
  return {
      report::percent(static_cast<double>(cell.solved()) / static_cast<double>(cell.runs.size())),
      100.0 * interval.lower, 100.0 * interval.upper};
}

report::Table machine_table(const CampaignOutcome& outcome) {
  report::Table table{{"Executed on", ""}};
  for (const auto& [label, value] : machine_description()) {
    table.rows.push_back({label, value});
  }
  if (!outcome.versions.empty()) {
    table.rows.push_back(
        {"Runs executed by", fmt::format("Handway {}", fmt::join(outcome.versions, ", "))});
  }
  if (outcome.workers == 0) {
    return table;
  }
  table.rows.push_back({"Simultaneous runs", fmt::format("{}", outcome.workers)});
  table.rows.push_back({"Last session", fmt::format("{} runs in {}", outcome.done,
                                                    duration_text(outcome.elapsed_s))});
  return table;
}

report::Table parameter_table(const Campaign& campaign) {
  report::Table table{{"Planner", "method", "parameters"}};
  for (const planning::CampaignPlanner& planner : campaign.planners) {
    std::string parameters;
    for (const auto& [key, value] : planner.parameters) {
      parameters += fmt::format("{}{} = {}", parameters.empty() ? "" : ", ", key, value);
    }
    table.rows.push_back({planner.label, planner.planner, parameters});
  }
  return table;
}

void write_campaign_report(const Campaign& campaign, const CampaignOutcome& outcome,
                           const fs::path& folder) {
  const std::vector<CampaignCell> cells = planning::campaign_cells(campaign, outcome.records);
  const std::vector<CampaignComparison> comparisons = planning::compare_planners(cells);
  const auto write = [&](const fs::path& name, const std::string& text) {
    geometric::replace_file(folder / name, text);
  };
  write("runs.csv", report::to_csv(runs_table(campaign, outcome.records)));
  write("summary.csv", report::to_csv(summary_table(campaign, cells)));
  write("ecdf.csv", report::to_csv(ecdf_table(campaign, cells)));
  write("boxplot.csv", report::to_csv(box_plot_table(campaign, cells)));
  if (const std::vector<ParameterGrid> grids = parameter_grids(campaign); !grids.empty()) {
    write("heatmaps.csv", report::to_csv(heat_map_table(campaign, grids, cells)));
  }
  write("comparisons.csv", report::to_csv(comparison_table(campaign, comparisons)));
  if (const report::Document groups = group_tables(outcome); !groups.empty()) {
    write("groups.csv", report::to_csv(group_table(outcome)));
    write("groups.md", report::to_markdown(groups));
  }
  if (!outcome.others.records.empty()) {
    write("other_paths.csv", report::to_csv(other_paths_table(outcome)));
  }
  make_out_folder(folder / "ompl");
  for (std::size_t i = 0; i < campaign.problems.size(); ++i) {
    const std::size_t planners = campaign.planners.size();
    write(fs::path("ompl") / (file_name_of(campaign.problems[i].name) + ".log"),
          ompl_log(campaign, std::span(cells).subspan(i * planners, planners)));
  }
  report::Document document = campaign_document(campaign, outcome, cells, comparisons);
  int drawings = 0;
  for (report::Part& part : document) {
    if (auto* figure = std::get_if<report::Figure>(&part)) {
      figure->file = fmt::format("drawings/{}.svg", ++drawings);
    }
  }
  report::write_report(document, folder);
}

}  // namespace handway::tools
