#include "reproduce_report.h"

#include "campaign_report.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/campaigns/campaign_statistics.h"
#include "handway/report/rendering/csv.h"
#include "handway/report/rendering/report_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace handway::tools {
namespace {

/// A row of Table 2 or 4: the published means, and the corresponding value of a run.
struct PaperRow {
  std::string label;
  std::vector<double> published;  ///< A number a column; NaN: not applicable.
  std::function<double(const planning::RunRecord&)> value;
};

/// A row of Table 3: the initial parameters with PMDs and, in the print in brackets, without.
struct PaperParameter {
  std::string label;
  std::string key;  ///< Ours.
  std::string with_pmds;
  std::string without_pmds;
};

inline constexpr const char* kTable2Machine = "Core2 CPU at 3.00 GHz, Windows";
inline constexpr const char* kTable4Machine = "I5 with 4 cores and 4 GB, Windows 7, MPI";

using planning::RunRecord;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double number(std::uint64_t count) { return static_cast<double>(count); }

// The share, in %, of the roadmap's sampled nodes with `count` PMDs.
double share_with_pmds(const RunRecord& run, std::size_t count) {
  if (run.nodes_per_pmds.size() < 2) {
    return kNone;
  }
  const double all =
      number(std::accumulate(run.nodes_per_pmds.begin() + 1, run.nodes_per_pmds.end(), 0UL));
  const std::uint64_t some = count < run.nodes_per_pmds.size() ? run.nodes_per_pmds[count] : 0;
  return all > 0.0 ? 100.0 * number(some) / all : kNone;
}

// Times of the parts of a run, of which the print has none.
void add_times_of_parts(std::vector<PaperRow>& rows, std::size_t columns) {
  const std::vector<double> unpublished(columns, kNone);
  rows.push_back(
      {"Time of sampling [s]", unpublished, [](const RunRecord& r) { return r.sampling_s; }});
  rows.push_back(
      {"Time of connecting [s]", unpublished, [](const RunRecord& r) { return r.connection_s; }});
}

/// Columns: reduced search space, full search space. 100 runs.
std::vector<PaperRow> paper_table_2() {
  std::vector<PaperRow> rows = {
      {"Time to find a solution [s]", {10.39, 915.28}, [](const RunRecord& r) { return r.time_s; }},
      {"Smoothing time [s]", {0.096, 15.20}, [](const RunRecord& r) { return r.smoothing_s; }},
      {"Final neighboring threshold (rho_a)",
       {0.0013, 0.0631},
       [](const RunRecord& r) { return r.final_rho_a; }},
      {"Maximum num. of trials (j x h loops)",
       {22.55, 270.44},
       [](const RunRecord& r) { return number(r.max_trials); }},
      {"Total num. of samples (numSamples)",
       {698.82, 7274.78},
       [](const RunRecord& r) { return number(r.samples); }},
      {"Total num. of nodes in the PRM",
       {29.18, 567.22},
       [](const RunRecord& r) { return number(r.nodes); }},
  };
  constexpr std::array<double, 4> kShares = {22.4, 26.5, 16.5, 34.7};
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    rows.push_back({fmt::format("% of PRM nodes with thumb-base + {} PMDs", i + 1),
                    {kShares[i], kNone},
                    [count = i + 1](const RunRecord& r) { return share_with_pmds(r, count); }});
  }
  rows.push_back({"Total nodes in the solution path", {3.66, 3.22}, [](const RunRecord& r) {
                    return number(r.path_nodes);
                  }});
  add_times_of_parts(rows, 2);
  return rows;
}

/// Columns: problems 1 to 4. 1,000 runs.
std::vector<PaperRow> paper_table_4() {
  std::vector<PaperRow> rows = {
      {"Time to find a solution [s]",
       {21.06, 7.75, 71.64, 24.09},
       [](const RunRecord& r) { return r.time_s; }},
      {"Smoothing time [s]",
       {0.124, 0.022, 0.821, 0.142},
       [](const RunRecord& r) { return r.smoothing_s; }},
      {"Number of samples",
       {1188.7, 437.7, 2093.8, 2205.6},
       [](const RunRecord& r) { return number(r.samples); }},
      {"Nodes in the PRM",
       {53.6, 24.6, 131.7, 81.9},
       [](const RunRecord& r) { return number(r.nodes); }},
      {"Nodes in solution path",
       {3.9, 3.4, 4.2, 4.9},
       [](const RunRecord& r) { return number(r.path_nodes); }},
  };
  add_times_of_parts(rows, 4);
  return rows;
}

std::vector<PaperParameter> paper_table_3() {
  return {{"rho_a (initial)", "rho_a", "0.001", "0.001"},
          {"K, neighbours", "k", "10", "10"},
          {"N, most samples (initial)", "max_samples", "100", "10000"},
          {"n_A, arm trials", "n_a", "10", "20"},
          {"n_H, hand trials", "n_h", "10", "20"},
          {"Growth of rho_a", "growth", "-", "-"},
          {"Largest rho_a (0: no limit)", "rho_max", "-", "-"},
          {"Samples in gaps between hypercubes", "fill_gaps", "-", "-"},
          {"N compared at each", "n_checked", "pass", "pass"},
          {"Edges of smoothing", "smoothing", "both-ways", "both-ways"}};
}

std::string text_of(double value) { return report::Cell(value).text(); }

/// A column of measured figures.
struct MeasuredColumn {
  std::string label;
  planning::CampaignCell cell;
};

using planning::CampaignCell;

// Mean over the runs that found a path, if the number exists.
std::vector<double> values_of(const PaperRow& row, const CampaignCell& cell) {
  std::vector<double> values = cell.of_solved({"", "", row.value});
  std::erase_if(values, [](double value) { return std::isnan(value); });
  return values;
}

report::Estimate mean_estimate(const std::vector<double>& values) {
  const planning::Interval interval = planning::mean_interval(values);
  return {{.value = planning::mean_of(values)}, interval.lower, interval.upper};
}

const std::string& parameter_of(const planning::CampaignPlanner& planner, const std::string& key) {
  static const std::string kUnset = "-";
  const auto found =
      std::ranges::find(planner.parameters, key, &planning::ParameterTexts::value_type::first);
  return found == planner.parameters.end() ? kUnset : found->second;
}

/// Runs, success with Wilson's interval, then the paper's rows: published value, and for
/// each column the mean with its 95 % interval over the runs that found a path.
/// @param published which column of the rows.
report::Table compared_table(const std::vector<PaperRow>& rows, std::size_t published,
                             const std::vector<MeasuredColumn>& columns) {
  report::Table table{{"", "published"}, {{"Runs", kNone}, {"Solved", kNone}}};
  for (const MeasuredColumn& column : columns) {
    table.columns.emplace_back(column.label);
    table.rows[0].emplace_back(column.cell.runs.size());
    table.rows[1].emplace_back(success(column.cell));
  }
  for (const PaperRow& row : rows) {
    std::vector<report::Cell> cells = {row.label, row.published[published]};
    for (const MeasuredColumn& column : columns) {
      cells.emplace_back(mean_estimate(values_of(row, column.cell)));
    }
    const bool applies = std::any_of(cells.begin() + 1, cells.end(),
                                     [](const report::Cell& cell) { return cell.text() != "-"; });
    if (applies) {
      table.rows.push_back(std::move(cells));
    }
  }
  std::vector<report::Cell> median = {"Median time of all runs [s]", kNone};
  for (const MeasuredColumn& column : columns) {
    median.emplace_back(planning::quantile_of(column.cell.times(), 0.5));
  }
  table.rows.push_back(std::move(median));
  return table;
}

/// Such a table without rows.
report::Table compared_csv() {
  return {{"table", "problem", "column", "runs", "solved", "figure", "published", "mean",
           "mean_lower", "mean_upper", "median"}};
}

/// Adds a row for programs for each column and figure.
/// @param table such as "2"; @param problem what the columns are about.
void add_compared_rows(report::Table& csv, const std::string& table, const std::string& problem,
                       const std::vector<PaperRow>& rows, std::size_t published,
                       const std::vector<MeasuredColumn>& columns) {
  for (const MeasuredColumn& column : columns) {
    for (const PaperRow& row : rows) {
      const std::vector<double> values = values_of(row, column.cell);
      const planning::Interval interval = planning::mean_interval(values);
      csv.rows.push_back({table, problem, column.label, column.cell.runs.size(),
                          column.cell.solved(), row.label, row.published[published],
                          planning::mean_of(values), interval.lower, interval.upper,
                          planning::quantile_of(values, 0.5)});
    }
  }
}

/// Table 3, with the parameters of two planners beside it.
report::Table parameters_compared(const planning::CampaignPlanner& with_pmds,
                                  const planning::CampaignPlanner& without_pmds) {
  report::Table table{{"Parameter", "published, PMDs", "ours, " + with_pmds.planner,
                       "published, no PMDs", "ours, " + without_pmds.planner}};
  for (const PaperParameter& parameter : paper_table_3()) {
    table.rows.push_back({parameter.label, parameter.with_pmds,
                          parameter_of(with_pmds, parameter.key), parameter.without_pmds,
                          parameter_of(without_pmds, parameter.key)});
  }
  return table;
}

namespace fs = std::filesystem;

constexpr const char* kFullPlanner = "full-prm";

std::vector<MeasuredColumn> columns_of(const ReproducedCampaign& part, std::string_view problem) {
  std::vector<MeasuredColumn> columns;
  for (CampaignCell& cell : planning::campaign_cells(part.campaign, part.outcome.records)) {
    if (!cell.runs.empty() &&
        part.campaign.problems[static_cast<std::size_t>(cell.problem)].name.starts_with(problem)) {
      const std::string label =
          part.campaign.planners[static_cast<std::size_t>(cell.planner)].label;
      columns.push_back({label, std::move(cell)});
    }
  }
  return columns;
}

// Labels of the campaign of Table 2: the print with its corridor that grows by equal steps.
constexpr std::array<const char*, 2> kLinearGrowth = {"pmd-prm: print, linear growth",
                                                      "full-prm: print, linear growth"};
constexpr std::array<const char*, 2> kSpaces = {"Reduced search space", "Full search space"};
constexpr double kReproduced = 0.25;  // of the published value: a larger difference counts

const CampaignCell* cell_of(const std::vector<MeasuredColumn>& columns, std::string_view label) {
  const auto found = std::ranges::find(columns, label, &MeasuredColumn::label);
  return found == columns.end() ? nullptr : &found->cell;
}

bool is_time(const PaperRow& row) { return row.label.find("[s]") != std::string::npos; }

// Says which figures of a search space are near the published ones and which are not.
std::string reproduced_figures(const std::vector<PaperRow>& rows, std::size_t space,
                               const CampaignCell& cell) {
  std::vector<std::string> near;
  std::vector<std::string> far;
  for (const PaperRow& row : rows) {
    const double published = row.published[space];
    const double mean = planning::mean_of(values_of(row, cell));
    if (is_time(row) || std::isnan(published) || std::isnan(mean)) {
      continue;
    }
    const bool is_near = std::abs(mean - published) <= kReproduced * published;
    (is_near ? near : far)
        .push_back(
            fmt::format("{} {} (published {})", row.label, text_of(mean), text_of(published)));
  }
  const auto listed = [](const std::vector<std::string>& figures) {
    return figures.empty() ? std::string("none") : fmt::format("{}", fmt::join(figures, "; "));
  };
  return fmt::format(
      "{}: {} of {} runs find a path. Within {:.0f} % of the published mean: {}. Not: {}.",
      kSpaces[space], cell.solved(), cell.runs.size(), 100.0 * kReproduced, listed(near),
      listed(far));
}

// Effort of the full by that of the reduced search space, measured and published.
std::string ratios_of_effort(const std::vector<PaperRow>& rows, const CampaignCell& reduced,
                             const CampaignCell& full) {
  std::vector<std::string> ratios;
  for (const PaperRow& row : rows) {
    if (!row.label.starts_with("Total num.")) {
      continue;
    }
    const double ours =
        planning::mean_of(values_of(row, full)) / planning::mean_of(values_of(row, reduced));
    ratios.push_back(fmt::format("{} {} (published {})", row.label, text_of(ours),
                                 text_of(row.published[1] / row.published[0])));
  }
  return fmt::format("Full divided by reduced search space: {}.", fmt::join(ratios, "; "));
}

/// Says first what is reproduced of Table 2, by the runs of the print with linear growth.
void add_what_is_reproduced(report::Document& document, const ReproducedCampaign& part) {
  const std::vector<MeasuredColumn> columns = columns_of(part, "");
  const CampaignCell* reduced = cell_of(columns, kLinearGrowth[0]);
  const CampaignCell* full = cell_of(columns, kLinearGrowth[1]);
  if (reduced == nullptr || full == nullptr) {
    return;
  }
  const std::vector<PaperRow> rows = paper_table_2();
  document.emplace_back(report::Heading{2, "What is reproduced of Table 2"});
  document.emplace_back(report::Paragraph{
      "The planners as printed, with a corridor that grows by equal steps. Computed from the runs "
      "below; times are left out, as they are those of other computers."});
  document.emplace_back(report::Paragraph{reproduced_figures(rows, 0, *reduced)});
  document.emplace_back(report::Paragraph{reproduced_figures(rows, 1, *full)});
  document.emplace_back(report::Paragraph{ratios_of_effort(rows, *reduced, *full)});
}

void add_table_2(report::Document& document, report::Table& csv, const ReproducedCampaign& part) {
  const std::vector<MeasuredColumn> columns = columns_of(part, "");
  document.emplace_back(report::Heading{2, "Table 2: reduced and full search space"});
  document.emplace_back(report::Paragraph{fmt::format(
      "Means over 100 runs in the paper, on a {}; ours with 95 % intervals (bootstrap), over the "
      "runs that found a path. Success with Wilson's 95 % interval.",
      kTable2Machine)});
  document.emplace_back(report::Paragraph{
      "\"Print, literal\": rho_a is multiplied by 1, 2, 3, … with the passes, as Algorithm 1 is "
      "printed. \"Print, linear growth\": rho_a grows by its initial value with each pass, as in "
      "the authors' program and logs. All else is as printed in both."});
  const std::vector<PaperRow> rows = paper_table_2();
  const auto samples_all_joints = [&](const MeasuredColumn& column) {
    return part.campaign.planners[static_cast<std::size_t>(column.cell.planner)].planner ==
           kFullPlanner;
  };
  for (std::size_t space = 0; space < kSpaces.size(); ++space) {
    std::vector<MeasuredColumn> shown;
    std::ranges::copy_if(columns, std::back_inserter(shown), [&](const MeasuredColumn& column) {
      return samples_all_joints(column) == (space == 1);
    });
    if (!shown.empty()) {
      document.emplace_back(report::Heading{3, kSpaces[space]});
      document.push_back(compared_table(rows, space, shown));
      add_compared_rows(csv, "2", kSpaces[space], rows, space, shown);
    }
  }
}

void add_table_4(report::Document& document, report::Table& csv,
                 const std::vector<ReproducedCampaign>& campaigns) {
  constexpr std::size_t kProblems = 4;
  document.emplace_back(report::Heading{2, "Table 4: four problems"});
  document.emplace_back(report::Paragraph{fmt::format(
      "Means from 1,000 runs in the paper, on an {}; ours with 95 % intervals, over the runs that "
      "found a path. \"As published\": the authors' own problem files (if HANDWAY_REFERENCE_DIR is "
      "set to their folder); the other columns use scenes that ship, built after the paper's "
      "figures. The paper chose N so that all runs found a path. On problem 4 as published, "
      "pmd-prm mostly finds no path. There N is 2,250, a little above the published mean, so that "
      "the means are over the quick runs only: see the share of solved runs. The default planner "
      "finds paths there, but takes longer, and has fewer runs.",
      kTable4Machine)});
  const std::vector<PaperRow> rows = paper_table_4();
  for (std::size_t problem = 0; problem < kProblems; ++problem) {
    std::vector<MeasuredColumn> columns;
    std::string title;
    for (const bool published : {false, true}) {
      for (const ReproducedCampaign& part : campaigns) {
        for (const planning::CampaignProblem& candidate : part.campaign.problems) {
          const bool matches = part.table == 4 &&
                               candidate.name.starts_with(fmt::format("{}:", problem + 1)) &&
                               candidate.name.ends_with("as published") == published;
          if (!matches) {
            continue;
          }
          title = published ? title : candidate.name;
          for (MeasuredColumn& column : columns_of(part, candidate.name)) {
            column.label += published ? ", as published" : ", our scene";
            columns.push_back(std::move(column));
          }
        }
      }
    }
    if (!columns.empty()) {
      document.emplace_back(report::Heading{3, fmt::format("Problem {}", title)});
      document.push_back(compared_table(rows, problem, columns));
      add_compared_rows(csv, "4", title, rows, problem, columns);
    }
  }
}

void add_table_3(report::Document& document, const planning::Campaign& campaign) {
  document.emplace_back(report::Heading{2, "Table 3: parameters"});
  document.push_back(parameters_compared(campaign.planners[0], campaign.planners[1]));
  document.emplace_back(report::Paragraph{
      "A run without a path ends after N samples. Table 3 has the initial values 100 "
      "(10,000); section 6.2 says that N was \"chosen large enough to allow finding a "
      "solution in all cases\", and the "
      "samples "
      "of Table 2 are more than 100. Here N is too large to end a run; only "
      "problem 4 of Table 4 has N = 2,250. rho_a is the initial value; its growth with the passes "
      "has no limit."});
}

void add_figure(report::Document& document, const ReproducedFigure& figure) {
  document.emplace_back(
      report::Heading{2, fmt::format("Fig. {}: {}", figure.number, figure.caption)});
  if (!figure.text.empty()) {
    document.emplace_back(report::Paragraph{figure.text});
  }
  document.insert(document.end(), figure.drawings.begin(), figure.drawings.end());
  if (figure.table) {
    document.push_back(*figure.table);
  }
  if (!figure.problem.empty()) {
    document.emplace_back(report::Paragraph{"Incomplete. " + figure.problem});
  }
}

}  // namespace

void write_reproduce_report(const std::set<int>& tables,
                            const std::vector<ReproducedCampaign>& campaigns,
                            const std::vector<ReproducedFigure>& figures, bool quick,
                            const fs::path& folder) {
  report::Document document = {
      report::Heading{1, "The tables and figures of the paper, reproduced"}};
  document.emplace_back(report::Paragraph{
      "J. Rosell, R. Suárez, C. Rosales, A. Pérez: Autonomous motion planning of a hand-arm "
      "robotic "
      "system based on captured human-like hand postures. Autonomous Robots 31 (2011)."});
  if (quick) {
    document.emplace_back(report::Paragraph{
        "Preview: few runs, ended after a few seconds. The numbers are not reliable."});
  }
  const auto incomplete = std::ranges::find_if(
      campaigns, [](const ReproducedCampaign& part) { return !part.outcome.complete; });
  if (incomplete != campaigns.end() && tables != std::set{3} && !tables.empty()) {
    document.emplace_back(report::Paragraph{"Incomplete: the runs were interrupted."});
  }
  for (const ReproducedCampaign& part : campaigns) {
    if (part.table == 2 && tables.contains(2)) {
      add_what_is_reproduced(document, part);
    }
  }
  report::Table csv = compared_csv();
  CampaignOutcome all;
  for (const ReproducedCampaign& part : campaigns) {
    all.done += part.outcome.done;
    all.elapsed_s += part.outcome.elapsed_s;
    all.workers = part.outcome.workers;
    all.versions = part.outcome.versions.empty() ? all.versions : part.outcome.versions;
    if (part.table == 2 && tables.contains(2)) {
      add_table_2(document, csv, part);
    }
    if (part.table == 2 && tables.contains(3)) {
      add_table_3(document, part.campaign);
    }
  }
  if (tables.contains(4)) {
    add_table_4(document, csv, campaigns);
  }
  for (const ReproducedFigure& figure : figures) {
    add_figure(document, figure);
  }
  document.emplace_back(report::Heading{2, "Machine"});
  document.push_back(machine_table(all));
  report::write_report(document, folder);
  geometric::replace_file(folder / "report.csv", report::to_csv(csv));
}

}  // namespace handway::tools
