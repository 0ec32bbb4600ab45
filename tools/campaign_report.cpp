#include "campaign_report.h"

#include "campaign_command.h"
#include "campaign_progress.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/campaigns/campaign_statistics.h"
#include "machine.h"
#include "numbers.h"
#include "report_document.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

std::vector<std::string> names(const Campaign& campaign, int problem, int planner) {
  return {campaign.problems[static_cast<std::size_t>(problem)].name,
          campaign.planners[static_cast<std::size_t>(planner)].label};
}

std::string whole(std::uint64_t value) { return fmt::format("{}", value); }

/// Column of the table of runs, after its problem and planner.
struct RunColumn {
  const char* name;
  std::string (*text)(const RunRecord&);
};

constexpr std::array kRunColumns = std::to_array<RunColumn>({
    {"seed", [](const RunRecord& run) { return whole(run.spec.seed); }},
    {"solved", [](const RunRecord& run) { return std::string(run.solved ? "true" : "false"); }},
    {"status", [](const RunRecord& run) { return run.status; }},
    {"time_s", [](const RunRecord& run) { return seconds_field(run.time_s); }},
    {"smoothing_s", [](const RunRecord& run) { return seconds_field(run.smoothing_s); }},
    {"sampling_s", [](const RunRecord& run) { return seconds_field(run.sampling_s); }},
    {"connection_s", [](const RunRecord& run) { return seconds_field(run.connection_s); }},
    {"samples", [](const RunRecord& run) { return whole(run.samples); }},
    {"nodes", [](const RunRecord& run) { return whole(run.nodes); }},
    {"edges", [](const RunRecord& run) { return whole(run.edges); }},
    {"passes", [](const RunRecord& run) { return whole(run.passes); }},
    {"max_trials", [](const RunRecord& run) { return whole(run.max_trials); }},
    {"final_rho_a", [](const RunRecord& run) { return number_field(run.final_rho_a); }},
    {"nodes_per_pmds",
     [](const RunRecord& run) { return fmt::format("{}", fmt::join(run.nodes_per_pmds, " ")); }},
    {"node_checks", [](const RunRecord& run) { return whole(run.node_checks); }},
    {"edge_checks", [](const RunRecord& run) { return whole(run.edge_checks); }},
    {"edges_tested", [](const RunRecord& run) { return whole(run.edges_tested); }},
    {"path_nodes", [](const RunRecord& run) { return whole(run.path_nodes); }},
    {"path_length", [](const RunRecord& run) { return number_field(run.path_length); }},
    {"resolution_mm",
     [](const RunRecord& run) { return number_field(geometric::millimetres(run.resolution)); }},
    {"min_clearance_mm",
     [](const RunRecord& run) { return number_field(geometric::millimetres(run.min_clearance)); }},
    {"certificate_checks", [](const RunRecord& run) { return whole(run.certificate_checks); }},
});

/// A row a run.
ReportTable runs_table(const Campaign& campaign, std::span<const RunRecord> records) {
  ReportTable table{{"problem", "planner"}, {}};
  for (const RunColumn& column : kRunColumns) {
    table.columns.emplace_back(column.name);
  }
  for (const RunRecord& run : records) {
    std::vector<std::string> row = names(campaign, run.spec.problem, run.spec.planner);
    for (const RunColumn& column : kRunColumns) {
      row.push_back(column.text(run));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// A row for each problem and planner: success with its interval, and for each measure mean,
/// its interval, deviation, quartiles, least and most over the runs that found a path.
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

/// A row for each step of the distribution of planning times.
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

/// A row for each problem, planner and measure: the values of a box plot.
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

/// A row for each pair of planners on a problem.
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

/// A planner's times in a drawing.
struct PlotSeries {
  std::string label;
  std::vector<double> values;  ///< s; infinite for runs without a path.
};

constexpr double kWidth = 760.0;
constexpr double kLeft = 60.0;
constexpr double kRight = 20.0;
constexpr double kPlotHeight = 260.0;
constexpr double kRowHeight = 26.0;
constexpr double kTop = 12.0;
constexpr double kAxisHeight = 40.0;
constexpr double kShortest = 1e-6;  // s; what is shorter is drawn here
// Okabe and Ito's colours, which colour-blind viewers distinguish.
constexpr std::array<const char*, 7> kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                "#e69f00", "#56b4e9", "#000000"};

const char* color(std::size_t i) { return kColors[i % kColors.size()]; }

/// Seconds on a logarithmic axis across the drawing; whole decades.
class TimeAxis {
 public:
  TimeAxis(std::span<const PlotSeries> series, double left) : left_(left) {
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    for (const PlotSeries& one : series) {
      for (const double value : one.values) {
        if (std::isfinite(value)) {
          least = std::min(least, std::max(value, kShortest));
          most = std::max(most, std::max(value, kShortest));
        }
      }
    }
    if (most > 0.0) {
      first_ = static_cast<int>(std::floor(std::log10(least)));
      last_ = std::max(first_ + 1, static_cast<int>(std::ceil(std::log10(most))));
    }
  }

  [[nodiscard]] double x(double value) const {
    const double decades = std::log10(std::max(value, kShortest)) - first_;
    return left_ + (kWidth - kRight - left_) * decades / (last_ - first_);
  }
  [[nodiscard]] std::string svg(double top, double bottom) const {
    std::string svg;
    for (int decade = first_; decade <= last_; ++decade) {
      const double at = x(std::pow(10.0, decade));
      svg += fmt::format(
          "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\" stroke=\"#ddd\"/>"
          "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4:g}</text>\n",
          at, top, bottom, bottom + 16.0, std::pow(10.0, decade));
    }
    return svg + fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">time [s]</text>\n",
                             (left_ + kWidth - kRight) / 2.0, bottom + 33.0);
  }

 private:
  double left_;
  int first_ = -3;
  int last_ = 1;
};

std::string drawing(double height, const std::string& content) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" role=\"img\">\n{2}</svg>",
      kWidth, height, content);
}

std::string step_line(const TimeAxis& axis, const PlotSeries& series, const char* stroke,
                      double bottom) {
  std::string points;
  double y = bottom;
  for (const planning::EcdfStep& step : planning::ecdf_of(series.values)) {
    const double x = axis.x(step.value);
    const double next = bottom - kPlotHeight * step.share;
    points += fmt::format("{0:.1f},{1:.1f} {0:.1f},{2:.1f} ", x, y, next);
    y = next;
  }
  points += fmt::format("{:.1f},{:.1f}", kWidth - kRight, y);
  return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n",
                     points, stroke);
}

std::string box(const TimeAxis& axis, const planning::BoxPlot& plot, const char* stroke,
                double middle) {
  constexpr double kHalf = 8.0;
  std::string svg = fmt::format(
      "<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{}\" y2=\"{}\" stroke=\"{}\"/>"
      "<rect x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"{}\" fill=\"#fff\" stroke=\"{}\"/>"
      "<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{}\" y2=\"{}\" stroke=\"{}\" stroke-width=\"3\"/>\n",
      axis.x(plot.lower_whisker), axis.x(plot.upper_whisker), middle, middle, stroke,
      axis.x(plot.lower_quartile), middle - kHalf,
      std::max(1.0, axis.x(plot.upper_quartile) - axis.x(plot.lower_quartile)), 2.0 * kHalf, stroke,
      axis.x(plot.median), axis.x(plot.median), middle - kHalf, middle + kHalf, stroke);
  for (const double outlier : plot.outliers) {
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{}\" r=\"2\" fill=\"none\" stroke=\"{}\"/>",
                       axis.x(outlier), middle, stroke);
  }
  return svg;
}

/// Draws the share of runs that found a path over time, on a logarithmic scale.
std::string ecdf_svg(std::span<const PlotSeries> series) {
  constexpr double kLegendLine = 18.0;
  constexpr int kShareLines = 5;
  const TimeAxis axis(series, kLeft);
  const double bottom = kTop + kPlotHeight;
  std::string svg = axis.svg(kTop, bottom);
  for (int i = 0; i <= kShareLines; ++i) {
    const double share = static_cast<double>(i) / kShareLines;
    const double y = bottom - kPlotHeight * share;
    svg += fmt::format(
        "<line x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#ddd\"/>"
        "<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{:.0f} %</text>\n",
        kLeft, kWidth - kRight, y, y, kLeft - 6.0, y + 4.0, 100.0 * share);
  }
  double legend = bottom + kAxisHeight + kLegendLine;
  for (std::size_t i = 0; i < series.size(); ++i) {
    svg += step_line(axis, series[i], color(i), bottom);
    svg += fmt::format(
        "<rect x=\"{}\" y=\"{:.1f}\" width=\"18\" height=\"4\" fill=\"{}\"/>"
        "<text x=\"{}\" y=\"{:.1f}\">{}</text>\n",
        kLeft, legend - 6.0, color(i), kLeft + 26.0, legend, html_escaped(series[i].label));
    legend += kLegendLine;
  }
  return drawing(legend, svg);
}

/// Boxes of the finite values side by side, on a logarithmic scale.
std::string box_plot_svg(std::span<const PlotSeries> series) {
  constexpr double kLabels = 220.0;
  const TimeAxis axis(series, kLabels);
  const double bottom = kTop + kRowHeight * static_cast<double>(series.size());
  std::string svg = axis.svg(kTop, bottom);
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double middle = kTop + kRowHeight * (static_cast<double>(i) + 0.5);
    svg += fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", kLabels - 8.0,
                       middle + 4.0, html_escaped(series[i].label));
    std::vector<double> finite = series[i].values;
    std::erase_if(finite, [](double value) { return !std::isfinite(value); });
    if (!finite.empty()) {
      svg += box(axis, planning::box_plot_of(finite), color(i), middle);
    }
  }
  return drawing(bottom + kAxisHeight, svg);
}

namespace fs = std::filesystem;
using planning::CampaignComparison;

constexpr std::size_t kMostCompared = 6;  // planners, for a table of pairs people can read
constexpr std::size_t kMostDrawn = 14;    // planners, for curves people can tell apart

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

// Returns the reasons of runs without a path, if there are some.
ReportTable failures(const Campaign& campaign, std::span<const CampaignCell> cells) {
  ReportTable table{{"Planner", "status", "runs", "example"}, {}};
  for (const CampaignCell& cell : cells) {
    std::set<std::string> listed;
    for (const planning::RunRecord& run : cell.runs) {
      if (!run.solved && listed.insert(run.status).second) {
        const auto count = std::ranges::count(cell.runs, run.status, &planning::RunRecord::status);
        table.rows.push_back({campaign.planners[static_cast<std::size_t>(cell.planner)].label,
                              run.status, fmt::format("{}", count), run.reason});
      }
    }
  }
  return table;
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
  document.push_back(ReportFigure{
      "Times of the runs that found a path: quartiles, whiskers up to 1.5 box lengths, outliers",
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
    document.push_back(ReportText{fmt::format("Incomplete: {} of {} runs are done.",
                                              outcome.records.size(), campaign.run_count())});
  }
  document.push_back(machine_table(outcome));
  document.push_back(ReportText{fmt::format(
      "Every run has {} thread(s) and a time limit of {:g} s. In brackets: Wilson's 95 % interval "
      "of the success rate. The median and the 95 % quantile of the time are over all runs; a run "
      "without a path counts as infinite (∞). All other figures are means over the runs that found "
      "a path. \"First is faster\": share of the pairs of one run of each planner in which the "
      "first planner is faster. p: two-sided Mann-Whitney test, then adjusted by Holm for all "
      "pairs of a problem.",
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

std::string success_text(const CampaignCell& cell) {
  const planning::Interval interval = planning::wilson_interval(cell.solved(), cell.runs.size());
  return fmt::format(
      "{} ({:.1f} to {:.1f})",
      percent_text(static_cast<double>(cell.solved()) / static_cast<double>(cell.runs.size())),
      100.0 * interval.lower, 100.0 * interval.upper);
}

ReportTable machine_table(const CampaignOutcome& outcome) {
  ReportTable table{{"Executed on", ""}, {}};
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
