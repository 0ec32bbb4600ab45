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

constexpr const char* kShareOfTime = "[% of the time]";

// Shares of the parts of a run in its whole time, smoothing included; the print has none.
void add_shares_of_time(std::vector<PaperRow>& rows, std::size_t columns) {
  const auto add = [&](const char* part, double RunRecord::*seconds) {
    rows.push_back({fmt::format("{} {}", part, kShareOfTime), std::vector<double>(columns, kNone),
                    [seconds](const RunRecord& run) {
                      // Planners without a roadmap don't measure their parts.
                      const bool measured = run.sampling_s + run.connection_s > 0.0;
                      const double all = run.time_s + run.smoothing_s;
                      return measured ? 100.0 * run.*seconds / all : kNone;
                    }});
  };
  add("Sampling", &RunRecord::sampling_s);
  add("Connecting", &RunRecord::connection_s);
  add("Smoothing", &RunRecord::smoothing_s);
}

constexpr const char* kPmdShares = "% of PRM nodes with thumb-base + ";

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
       [](const RunRecord& r) { return r.max_trials > 0 ? number(r.max_trials) : kNone; }},
      {"Total num. of samples (numSamples)",
       {698.82, 7274.78},
       [](const RunRecord& r) { return number(r.samples); }},
      {"Total num. of nodes in the PRM",
       {29.18, 567.22},
       [](const RunRecord& r) { return number(r.nodes); }},
  };
  constexpr std::array<double, 4> kShares = {22.4, 26.5, 16.5, 34.7};
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    rows.push_back({fmt::format("{}{} PMDs", kPmdShares, i + 1),
                    {kShares[i], kNone},
                    [count = i + 1](const RunRecord& r) { return share_with_pmds(r, count); }});
  }
  rows.push_back({"Total nodes in the solution path", {3.66, 3.22}, [](const RunRecord& r) {
                    return number(r.path_nodes);
                  }});
  add_shares_of_time(rows, 2);
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
  add_shares_of_time(rows, 4);
  return rows;
}

std::vector<PaperParameter> paper_table_3() {
  return {{"rho_a (initial)", "rho_a", "0.001", "0.001"},
          {"K, neighbours", "k", "10", "10"},
          {"N, most samples (initial)", "max_samples", "100", "10000"},
          {"n_A, arm trials", "n_a", "10", "20"},
          {"n_H, hand trials", "n_h", "10", "20"},
          {"Growth of rho_a", "growth", "factorial", "factorial"},
          {"Largest rho_a (0: no limit)", "rho_max", "0", "0"},
          {"Samples in gaps between hypercubes", "fill_gaps", "false", "false"},
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

// Labels of planners in the campaigns.
constexpr std::array<const char*, 2> kLiteral = {"pmd-prm: print, literal",
                                                 "full-prm: print, literal"};
constexpr std::array<const char*, 2> kLinearGrowth = {"pmd-prm: print, linear growth",
                                                      "full-prm: print, linear growth"};
constexpr std::array<const char*, 2> kSpaces = {"Reduced search space", "Full search space"};
constexpr double kReproduced = 0.25;   // of the published value: a larger difference counts
constexpr double kSharesMoved = 10.0;  // % of the nodes: more in other shares count

constexpr std::size_t kProblems = 4;  // of Table 4

bool is_problem(const planning::CampaignProblem& candidate, std::size_t problem) {
  return candidate.name.starts_with(fmt::format("{}:", problem + 1));
}
bool is_authors_file(const planning::CampaignProblem& candidate) {
  return candidate.name.find("file ") != std::string::npos;
}

const CampaignCell* cell_of(const std::vector<MeasuredColumn>& columns, std::string_view label) {
  const auto found = std::ranges::find(columns, label, &MeasuredColumn::label);
  return found == columns.end() ? nullptr : &found->cell;
}

bool is_time(const PaperRow& row) { return row.label.find("[s]") != std::string::npos; }
bool is_pmd_share(const PaperRow& row) { return row.label.starts_with(kPmdShares); }

/// Findings of a comparison with the print.
class Findings {
 public:
  void add(bool reproduced, std::string text) {
    (reproduced ? near_ : far_).push_back(std::move(text));
  }
  void add(const std::string& label, double ours, double published) {
    if (!std::isnan(ours) && !std::isnan(published)) {
      add(std::abs(ours - published) <= kReproduced * published,
          fmt::format("{} {} ({})", label, text_of(ours), text_of(published)));
    }
  }
  // In the print all runs find a path.
  void add_success(const CampaignCell& cell) {
    add(cell.solved() == cell.runs.size(),
        fmt::format("{} of {} runs find a path (all)", cell.solved(), cell.runs.size()));
  }

  [[nodiscard]] std::string text(const std::string& subject) const {
    const auto listed = [](const std::vector<std::string>& list) {
      return list.empty() ? std::string("nothing") : fmt::format("{}", fmt::join(list, "; "));
    };
    return fmt::format("{}: reproduced: {}. Not reproduced: {}.", subject, listed(near_),
                       listed(far_));
  }

 private:
  std::vector<std::string> near_;
  std::vector<std::string> far_;
};

// Adds how the nodes are distributed over the numbers of PMDs, as one finding.
void add_pmd_shares(Findings& findings, const std::vector<PaperRow>& rows,
                    const CampaignCell& cell) {
  std::vector<std::string> ours;
  std::vector<std::string> published;
  double moved = 0.0;
  for (const PaperRow& row : rows) {
    if (is_pmd_share(row)) {
      const double mean = planning::mean_of(values_of(row, cell));
      ours.push_back(fmt::format("{:.0f}", mean));
      published.push_back(fmt::format("{:.0f}", row.published[0]));
      moved += 0.5 * std::abs(mean - row.published[0]);
    }
  }
  if (!std::isnan(moved)) {
    findings.add(moved <= kSharesMoved,
                 fmt::format("nodes with 1 to {} PMDs {} % ({} %)", ours.size(),
                             fmt::join(ours, "/"), fmt::join(published, "/")));
  }
}

// Success, and the figures that don't depend on the computer.
Findings findings_of(const std::vector<PaperRow>& rows, std::size_t column,
                     const CampaignCell& cell) {
  Findings findings;
  findings.add_success(cell);
  for (const PaperRow& row : rows) {
    if (!is_time(row) && !is_pmd_share(row)) {
      findings.add(row.label, planning::mean_of(values_of(row, cell)), row.published[column]);
    }
  }
  return findings;
}

// Effort of the full by that of the reduced search space.
Findings ratios_of_effort(const std::vector<PaperRow>& rows, const CampaignCell& reduced,
                          const CampaignCell& full) {
  Findings findings;
  for (const PaperRow& row : rows) {
    if (row.label.find(" num. ") != std::string::npos) {
      findings.add(
          row.label,
          planning::mean_of(values_of(row, full)) / planning::mean_of(values_of(row, reduced)),
          row.published[1] / row.published[0]);
    }
  }
  return findings;
}

// Sentences on Table 2, from the runs of the print with linear growth; empty without them.
std::string reproduced_of_table_2(const ReproducedCampaign& part) {
  const std::vector<MeasuredColumn> columns = columns_of(part, "");
  const std::vector<PaperRow> rows = paper_table_2();
  std::array<const CampaignCell*, 2> cells{};
  std::string text = "Table 2. ";
  for (std::size_t space = 0; space < kSpaces.size(); ++space) {
    cells[space] = cell_of(columns, kLinearGrowth[space]);
    if (cells[space] == nullptr) {
      return "";
    }
    Findings findings = findings_of(rows, space, *cells[space]);
    if (space == 0) {
      add_pmd_shares(findings, rows, *cells[space]);
    }
    text += findings.text(kSpaces[space]) + " ";
  }
  text += ratios_of_effort(rows, *cells[0], *cells[1]).text("Full divided by reduced") + " ";
  for (std::size_t space = 0; space < kSpaces.size(); ++space) {
    if (const CampaignCell* literal = cell_of(columns, kLiteral[space])) {
      text += fmt::format("{}, print read literally: {} of {} runs find a path. ", kSpaces[space],
                          literal->solved(), literal->runs.size());
    }
  }
  return text;
}

// Sentences on Table 4, from the runs of the print with linear growth on the scenes that ship.
std::string reproduced_of_table_4(const ReproducedCampaign& part) {
  const std::vector<PaperRow> rows = paper_table_4();
  std::string text;
  for (std::size_t problem = 0; problem < kProblems; ++problem) {
    for (const planning::CampaignProblem& candidate : part.campaign.problems) {
      const std::vector<MeasuredColumn> columns = columns_of(part, candidate.name);
      const CampaignCell* cell = cell_of(columns, kLinearGrowth[0]);
      if (is_problem(candidate, problem) && !is_authors_file(candidate) && cell != nullptr) {
        text +=
            findings_of(rows, problem, *cell).text(fmt::format("Problem {}", candidate.name)) + " ";
      }
    }
  }
  return text.empty() ? "" : "Table 4, on our reconstructions of the scenes. " + text;
}

/// Says first what is reproduced, and what is not.
void add_what_is_reproduced(report::Document& document, const std::set<int>& tables,
                            const std::vector<ReproducedCampaign>& campaigns) {
  std::vector<std::string> texts;
  for (const ReproducedCampaign& part : campaigns) {
    std::string text = part.table == 2 && tables.contains(2) ? reproduced_of_table_2(part)
                       : part.table == 4                     ? reproduced_of_table_4(part)
                                                             : std::string();
    if (!text.empty()) {
      text.pop_back();  // the space after the last sentence
      texts.push_back(std::move(text));
    }
  }
  if (texts.empty()) {
    return;
  }
  for (std::string& text : texts) {
    document.emplace_back(report::Paragraph{std::move(text)});
  }
  document.emplace_back(report::Paragraph{fmt::format(
      "These are means of the runs below that found a path, by the planners as printed with linear "
      "growth of rho_a, and in brackets the published means. A mean counts as reproduced within "
      "{:.0f} % of the published one, a distribution of nodes if at most {:.0f} % of them are in "
      "other shares. Times are left out, as they are those of other computers.",
      100.0 * kReproduced, kSharesMoved)});
}

void add_table_2(report::Document& document, report::Table& csv, const ReproducedCampaign& part) {
  const std::vector<MeasuredColumn> columns = columns_of(part, "");
  document.emplace_back(report::Heading{2, "Table 2: reduced and full search space"});
  document.emplace_back(report::Paragraph{fmt::format(
      "Means over 100 runs in the paper, on a {}; ours with 95 % intervals (bootstrap), over the "
      "runs that found a path. Success with Wilson's 95 % interval.",
      kTable2Machine)});
  document.emplace_back(report::Paragraph{
      "\"Print, literal\": rho_a is multiplied by 1, 2, 3, … with the passes, as Algorithm 4 is "
      "printed. \"Print, linear growth\": rho_a grows by its initial value with each pass, as in "
      "the authors' program and logs. Edges are certified along their whole length in both; all "
      "else is as printed."});
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

std::vector<MeasuredColumn> columns_of_problem(const std::vector<ReproducedCampaign>& campaigns,
                                               std::size_t problem, std::string& title) {
  std::vector<MeasuredColumn> columns;
  for (const bool of_authors : {false, true}) {
    for (const ReproducedCampaign& part : campaigns) {
      for (const planning::CampaignProblem& candidate : part.campaign.problems) {
        if (part.table != 4 || !is_problem(candidate, problem) ||
            is_authors_file(candidate) != of_authors) {
          continue;
        }
        title = title.empty() ? candidate.name : title;
        for (MeasuredColumn& column : columns_of(part, candidate.name)) {
          column.label += ", " + (of_authors ? candidate.name.substr(3) : "our scene");
          columns.push_back(std::move(column));
        }
      }
    }
  }
  return columns;
}

// Section 6.3: "the time to find a solution was larger in the third task because the validation of
// the PRM edges is time-consuming".
std::string shares_of_time(const std::string& title, const std::vector<PaperRow>& rows,
                           const std::vector<MeasuredColumn>& columns) {
  const CampaignCell* cell = cell_of(columns, std::string(kLinearGrowth[0]) + ", our scene");
  if (cell == nullptr || cell->solved() == 0) {
    return "";
  }
  std::vector<std::string> parts;
  for (const PaperRow& row : rows) {
    if (const std::size_t unit = row.label.find(kShareOfTime); unit != std::string::npos) {
      parts.push_back(fmt::format("{}{:.0f} %", row.label.substr(0, unit),
                                  planning::mean_of(values_of(row, *cell))));
    }
  }
  return fmt::format("{}: {}.", title, fmt::join(parts, ", "));
}

// Runs on a file of the authors' that no published figures are about.
void add_file(report::Document& document, report::Table& csv,
              const std::vector<ReproducedCampaign>& campaigns, const std::string& name) {
  std::vector<MeasuredColumn> columns;
  for (const ReproducedCampaign& part : campaigns) {
    if (part.campaign.problems.front().name == name) {
      std::ranges::move(columns_of(part, name), std::back_inserter(columns));
    }
  }
  if (columns.empty()) {
    return;
  }
  std::vector<PaperRow> rows = paper_table_4();
  for (PaperRow& row : rows) {
    row.published.assign(1, kNone);
  }
  document.emplace_back(report::Heading{3, "The " + name});
  document.emplace_back(report::Paragraph{
      "A problem of the authors' that is not one of Fig. 16; no published figures are about it. "
      "The "
      "runs of pmd-prm end after N = 2,250 samples, so that their means are over the quick ones."});
  document.push_back(compared_table(rows, 0, columns));
  add_compared_rows(csv, "4", name, rows, 0, columns);
}

void add_table_4(report::Document& document, report::Table& csv,
                 const std::vector<ReproducedCampaign>& campaigns) {
  document.emplace_back(report::Heading{2, "Table 4: four problems"});
  document.emplace_back(report::Paragraph{fmt::format(
      "Means from 1,000 runs in the paper, on an {}; ours with 95 % intervals (bootstrap), over "
      "the "
      "runs that found a path. \"Our scene\": scenes that ship, built after the paper's figures; "
      "\"file …\": the authors' own problem files (if HANDWAY_REFERENCE_DIR is set to their "
      "folder), whose relation to the figures is not known. The paper chose N so that all runs "
      "found a path.",
      kTable4Machine)});
  const std::vector<PaperRow> rows = paper_table_4();
  std::vector<std::string> shares;
  for (std::size_t problem = 0; problem < kProblems; ++problem) {
    std::string title;
    const std::vector<MeasuredColumn> columns = columns_of_problem(campaigns, problem, title);
    if (columns.empty()) {
      continue;
    }
    document.emplace_back(report::Heading{3, fmt::format("Problem {}", title)});
    document.push_back(compared_table(rows, problem, columns));
    add_compared_rows(csv, "4", title, rows, problem, columns);
    if (std::string text = shares_of_time("Problem " + title, rows, columns); !text.empty()) {
      shares.push_back(std::move(text));
    }
  }
  if (!shares.empty()) {
    document.emplace_back(report::Paragraph{fmt::format(
        "Where the time goes, as printed with linear growth on our scenes (the paper says that the "
        "third task takes longest because the validation of edges does). {}",
        fmt::join(shares, " "))});
  }
  add_file(document, csv, campaigns, "file shelfT2");
}

void add_table_3(report::Document& document, const planning::Campaign& campaign) {
  document.emplace_back(report::Heading{2, "Table 3: parameters"});
  document.push_back(parameters_compared(campaign.planners[0], campaign.planners[1]));
  document.emplace_back(report::Paragraph{
      "A run without a path ends after N samples. Table 3 has the initial values 100 (10,000); "
      "section 6.2 says that N was \"chosen large enough to allow finding a solution in all "
      "cases\", "
      "and the samples of Table 2 are more than 100. \"Ours\" is the print, literally: N is "
      "several "
      "times the published samples; with linear growth it is too large to end a run. rho_a is the "
      "initial value. "
      "The rows from its growth on are Algorithm 4's; the runs with linear growth differ in this "
      "one."});
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
                            const std::vector<ReproducedFigure>& figures,
                            std::optional<double> preview_s, const fs::path& folder) {
  report::Document document = {
      report::Heading{1, "The tables and figures of the paper, reproduced"}};
  add_what_is_reproduced(document, tables, campaigns);
  if (preview_s) {
    document.emplace_back(report::Paragraph{
        fmt::format("Preview, made in {:.0f} s: few runs that ended early, on the scenes and "
                    "the recording that ship alone. The numbers are not reliable.",
                    *preview_s)});
  }
  document.emplace_back(report::Paragraph{
      "J. Rosell, R. Suárez, C. Rosales, A. Pérez: Autonomous motion planning of a hand-arm "
      "robotic "
      "system based on captured human-like hand postures. Autonomous Robots 31 (2011)."});
  const auto incomplete = std::ranges::find_if(
      campaigns, [](const ReproducedCampaign& part) { return !part.outcome.complete; });
  if (incomplete != campaigns.end() && tables != std::set{3} && !tables.empty()) {
    document.emplace_back(report::Paragraph{"Incomplete: the runs were interrupted."});
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
