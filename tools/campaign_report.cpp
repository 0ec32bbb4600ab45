#include "campaign_report.h"

#include "campaign_plots.h"
#include "campaign_progress.h"
#include "campaign_tables.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/planning/campaigns/campaign_summary.h"
#include "heat_map.h"
#include "machine.h"
#include "number_text.h"
#include "ompl_log.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;
using planning::Campaign;
using planning::CampaignCell;
using planning::CampaignComparison;

constexpr std::size_t kMostCompared = 6;  // planners, for a table of pairs people can read
constexpr std::size_t kMostDrawn = 14;    // planners, for curves people can tell apart

std::string success_text(const CampaignCell& cell) {
  const planning::Interval interval = planning::wilson_interval(cell.solved(), cell.runs.size());
  return fmt::format(
      "{} ({:.1f} to {:.1f})",
      percent_text(static_cast<double>(cell.solved()) / static_cast<double>(cell.runs.size())),
      100.0 * interval.lower, 100.0 * interval.upper);
}

ReportTable overview(const Campaign& campaign, std::span<const CampaignCell> cells) {
  ReportTable table{{"Planner", "runs", "solved", "median [s]", "mean [s]", "95 % [s]", "samples",
                     "nodes", "checks", "path nodes", "path length", "clearance [mm]"},
                    {}};
  for (const CampaignCell& cell : cells) {
    std::vector<std::string> row = {campaign.planners[static_cast<std::size_t>(cell.planner)].label,
                                    fmt::format("{}", cell.runs.size())};
    if (cell.runs.empty()) {
      row.resize(table.columns.size(), "-");
      table.rows.push_back(std::move(row));
      continue;
    }
    const std::vector<double> times = cell.times();
    const auto mean = [&](const char* key) {
      const auto& measures = planning::run_measures();
      const auto measure = std::ranges::find(measures, key, &planning::RunMeasure::key);
      return number_text(planning::mean_of(cell.of_solved(*measure)));
    };
    row.push_back(success_text(cell));
    row.push_back(number_text(planning::quantile_of(times, 0.5)));
    row.push_back(mean("time_s"));
    row.push_back(number_text(planning::quantile_of(times, 0.95)));
    for (const char* key :
         {"samples", "nodes", "checks", "path_nodes", "path_length", "min_clearance_mm"}) {
      row.push_back(mean(key));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string p_text(double p) { return p < 1e-4 ? "< 0.0001" : fmt::format("{:.4f}", p); }

ReportTable pairs(const Campaign& campaign, std::span<const CampaignComparison> comparisons,
                  int problem) {
  ReportTable table{{"Planners", "first is faster", "p", "p (Holm)"}, {}};
  for (const CampaignComparison& comparison : comparisons) {
    if (comparison.problem == problem) {
      table.rows.push_back(
          {fmt::format("{} : {}",
                       campaign.planners[static_cast<std::size_t>(comparison.first)].label,
                       campaign.planners[static_cast<std::size_t>(comparison.second)].label),
           percent_text(comparison.test.effect), p_text(comparison.test.p),
           p_text(comparison.adjusted_p)});
    }
  }
  return table;
}

// Why runs ended without a path, where some did.
ReportTable failures(const Campaign& campaign, std::span<const CampaignCell> cells) {
  ReportTable table{{"Planner", "status", "runs", "for example"}, {}};
  for (const CampaignCell& cell : cells) {
    std::set<std::string> told;
    for (const planning::RunRecord& run : cell.runs) {
      if (!run.solved && told.insert(run.status).second) {
        const auto count = std::ranges::count(cell.runs, run.status, &planning::RunRecord::status);
        table.rows.push_back({campaign.planners[static_cast<std::size_t>(cell.planner)].label,
                              run.status, fmt::format("{}", count), run.reason});
      }
    }
  }
  return table;
}

// The cells that curves and boxes are drawn of: where there are many, those that no heat
// map shows.
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

void add_problem(ReportDocument& document, const Campaign& campaign,
                 std::span<const CampaignCell> cells,
                 std::span<const CampaignComparison> comparisons,
                 std::span<const ParameterGrid> grids) {
  const int problem = cells.front().problem;
  document.push_back(ReportHeading{2, campaign.problems[static_cast<std::size_t>(problem)].name});
  document.push_back(overview(campaign, cells));
  if (ReportTable table = failures(campaign, cells); !table.rows.empty()) {
    document.push_back(ReportText{"Runs without a path:"});
    document.push_back(std::move(table));
  }
  for (const ParameterGrid& grid : grids) {
    document.push_back(
        ReportFigure{fmt::format("{}: median time by {} and {}", grid.planner, grid.x, grid.y),
                     heat_map_svg(grid, cells), "heatmaps.csv", ""});
  }
  std::vector<PlotSeries> series;
  for (const CampaignCell& cell : curves_of(cells, grids)) {
    series.push_back(
        {campaign.planners[static_cast<std::size_t>(cell.planner)].label, cell.times()});
  }
  if (series.empty()) {
    return;
  }
  document.push_back(
      ReportFigure{"Share of runs solved within a time", ecdf_svg(series), "ecdf.csv", ""});
  document.push_back(
      ReportFigure{"Times of the runs that found a path: quartiles, whiskers to 1.5 "
                   "box lengths, outliers",
                   box_plot_svg(series), "boxplot.csv", ""});
  if (cells.size() > 1 && cells.size() <= kMostCompared) {
    document.push_back(pairs(campaign, comparisons, problem));
  }
}

ReportDocument campaign_document(const Campaign& campaign, const CampaignOutcome& outcome,
                                 std::span<const CampaignCell> cells,
                                 std::span<const CampaignComparison> comparisons) {
  ReportDocument document;
  document.push_back(ReportHeading{1, campaign.name});
  if (!campaign.description.empty()) {
    document.push_back(ReportText{campaign.description});
  }
  if (!outcome.complete) {
    document.push_back(ReportText{fmt::format("Not complete: {} of {} runs are done.",
                                              outcome.records.size(), campaign.run_count())});
  }
  document.push_back(machine_table(outcome));
  document.push_back(ReportText{fmt::format(
      "Every run has {} thread(s) and {:g} s. In brackets: Wilson's 95 % interval of the chance of "
      "success. Median and 95 % quantile of the time are of all runs, one without a path takes "
      "forever (∞); all other figures are means of the runs that found a path. \"First is "
      "faster\": "
      "how often, in pairs of one run of each planner; p: two-sided Mann-Whitney test, then "
      "adjusted by Holm for all pairs of a problem.",
      campaign.threads, campaign.time_limit_s)});
  const std::vector<ParameterGrid> grids = parameter_grids(campaign);
  for (std::size_t begin = 0; begin < cells.size(); begin += campaign.planners.size()) {
    add_problem(document, campaign, cells.subspan(begin, campaign.planners.size()), comparisons,
                grids);
  }
  document.push_back(ReportHeading{2, "Parameters"});
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

ReportTable machine_table(const CampaignOutcome& outcome) {
  ReportTable table{{"Carried out on", ""}, {}};
  for (const auto& [label, value] : machine_description()) {
    table.rows.push_back({label, value});
  }
  if (!outcome.versions.empty()) {
    table.rows.push_back(
        {"Runs made by", fmt::format("Handway {}", fmt::join(outcome.versions, ", "))});
  }
  if (outcome.workers == 0) {
    return table;
  }
  table.rows.push_back({"Runs at a time", fmt::format("{}", outcome.workers)});
  table.rows.push_back({"Last session", fmt::format("{} runs in {}", outcome.done,
                                                    duration_text(outcome.elapsed_s))});
  return table;
}

ReportTable parameter_table(const Campaign& campaign) {
  ReportTable table{{"Planner", "method", "parameters"}, {}};
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
  write("runs.csv", to_csv(runs_table(campaign, outcome.records)));
  write("summary.csv", to_csv(summary_table(campaign, cells)));
  write("ecdf.csv", to_csv(ecdf_table(campaign, cells)));
  write("boxplot.csv", to_csv(box_plot_table(campaign, cells)));
  if (const std::vector<ParameterGrid> grids = parameter_grids(campaign); !grids.empty()) {
    write("heatmaps.csv", to_csv(heat_map_table(campaign, grids, cells)));
  }
  write("comparisons.csv", to_csv(comparison_table(campaign, comparisons)));
  make_out_folder(folder / "ompl");
  for (std::size_t i = 0; i < campaign.problems.size(); ++i) {
    const std::size_t planners = campaign.planners.size();
    write(fs::path("ompl") / (file_name_of(campaign.problems[i].name) + ".log"),
          ompl_log(campaign, std::span(cells).subspan(i * planners, planners)));
  }
  ReportDocument document = campaign_document(campaign, outcome, cells, comparisons);
  make_out_folder(folder / "drawings");
  int drawings = 0;
  for (ReportPart& part : document) {
    if (auto* figure = std::get_if<ReportFigure>(&part)) {
      figure->file = fmt::format("drawings/{}.svg", ++drawings);
      write(figure->file, to_svg(*figure));
    }
  }
  write("report.md", to_markdown(document));
  write("report.html", to_html(document));
}

}  // namespace handway::tools
