#include "reproduce_report.h"

#include "campaign_report.h"
#include "handway/geometric/io/replace_file.h"
#include "number_text.h"
#include "paper_tables.h"
#include "reproduce_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <string_view>

namespace handway::tools {
namespace {

namespace fs = std::filesystem;
using planning::CampaignCell;

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

void add_table_2(ReportDocument& document, ReportTable& csv, const ReproducedCampaign& part) {
  const std::vector<MeasuredColumn> columns = columns_of(part, "");
  document.push_back(ReportHeading{2, "Table 2: reduced and full search space"});
  document.push_back(ReportText{fmt::format(
      "Means over 100 runs in the paper, on a {}; ours with 95 % intervals (Student's t), over the "
      "runs that found a path. Success with Wilson's 95 % interval.",
      kTable2Machine)});
  const std::vector<PaperRow> rows = paper_table_2();
  const auto samples_all_joints = [&](const MeasuredColumn& column) {
    return part.campaign.planners[static_cast<std::size_t>(column.cell.planner)].planner ==
           kFullPlanner;
  };
  for (std::size_t space = 0; space < 2; ++space) {
    std::vector<MeasuredColumn> shown;
    std::ranges::copy_if(columns, std::back_inserter(shown), [&](const MeasuredColumn& column) {
      return samples_all_joints(column) == (space == 1);
    });
    if (!shown.empty()) {
      const char* name = space == 0 ? "Reduced search space" : "Full search space";
      document.push_back(ReportHeading{3, name});
      document.push_back(compared_table(rows, space, shown));
      add_compared_rows(csv, "2", name, rows, space, shown);
    }
  }
  const auto mean_time = [&](const std::string& label) {
    const auto column = std::ranges::find(columns, label, &MeasuredColumn::label);
    return column == columns.end()
               ? std::numeric_limits<double>::quiet_NaN()
               : planning::mean_of(column->cell.of_solved(planning::run_measures().front()));
  };
  const double as_printed = mean_time("Full") / mean_time("Reduced");
  const double as_shipped = mean_time("full-prm as it ships") / mean_time("pmd-prm as it ships");
  document.push_back(
      ReportText{fmt::format("Full by reduced, mean times: {} as printed, {} as the planners ship "
                             "(ρₐ at most 0.05), {} in "
                             "the paper.",
                             number_text(as_printed), number_text(as_shipped),
                             number_text(rows.front().published[1] / rows.front().published[0]))});
}

void add_table_4(ReportDocument& document, ReportTable& csv,
                 const std::vector<ReproducedCampaign>& campaigns) {
  constexpr std::size_t kProblems = 4;
  document.push_back(ReportHeading{2, "Table 4: four problems"});
  document.push_back(ReportText{fmt::format(
      "Means from 1,000 runs in the paper, on an {}; ours with 95 % intervals, over the runs that "
      "found a path. \"As published\" are the authors' own problem files (where "
      "HANDWAY_REFERENCE_DIR names their folder), the others scenes that ship, built after the "
      "paper's figures. The paper chose N so that all runs found a path. On problem 4 as published "
      "pmd-prm mostly finds none; there N is 2,250, a little above the published mean, so that its "
      "figures are those of the quick runs only: look at the share of runs that were solved. The "
      "default planner finds one there, but takes long, and has fewer runs.",
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
      document.push_back(ReportHeading{3, fmt::format("Problem {}", title)});
      document.push_back(compared_table(rows, problem, columns));
      add_compared_rows(csv, "4", title, rows, problem, columns);
    }
  }
}

void add_table_3(ReportDocument& document, const planning::Campaign& campaign) {
  document.push_back(ReportHeading{2, "Table 3: parameters"});
  document.push_back(parameters_compared(campaign.planners[0], campaign.planners[1]));
  document.push_back(ReportText{
      "N ends a run without a path. Table 3 prints 100 (10,000) as initial values; section 6.2 "
      "says "
      "that N was \"chosen large enough to allow finding a solution in all cases\", and the "
      "samples "
      "of Table 2 are more than 100. Here N is large enough not to end a run; Table 2 has columns "
      "for N = 100 and 10,000, compared at the end of each pass as printed, and problem 4 of Table "
      "4 has N = 2,250. rho_a is the value at the start; it is multiplied by 1, 2, 3, … with the "
      "passes, without limit."});
}

void add_figure(ReportDocument& document, const ReproducedFigure& figure) {
  document.push_back(ReportHeading{2, fmt::format("Fig. {}: {}", figure.number, figure.caption)});
  if (!figure.text.empty()) {
    document.push_back(ReportText{figure.text});
  }
  document.insert(document.end(), figure.pictures.begin(), figure.pictures.end());
  if (figure.table) {
    document.push_back(*figure.table);
  }
  if (!figure.problem.empty()) {
    document.push_back(ReportText{"Not all of it is there. " + figure.problem});
  }
}

}  // namespace

void write_reproduce_report(const std::set<int>& tables,
                            const std::vector<ReproducedCampaign>& campaigns,
                            const std::vector<ReproducedFigure>& figures, bool quick,
                            const fs::path& folder) {
  ReportDocument document = {ReportHeading{1, "The paper's tables and figures, made again"}};
  document.push_back(ReportText{
      "J. Rosell, R. Suárez, C. Rosales, A. Pérez: Autonomous motion planning of a hand-arm "
      "robotic "
      "system based on captured human-like hand postures. Autonomous Robots 31 (2011)."});
  if (quick) {
    document.push_back(ReportText{
        "A quick look: few runs, cut short after a few seconds. Take no figures from it."});
  }
  const auto incomplete = std::ranges::find_if(
      campaigns, [](const ReproducedCampaign& part) { return !part.outcome.complete; });
  if (incomplete != campaigns.end() && tables != std::set{3} && !tables.empty()) {
    document.push_back(ReportText{"Not complete: the runs were interrupted."});
  }
  ReportTable csv = compared_csv();
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
  document.push_back(ReportHeading{2, "Machine"});
  document.push_back(machine_table(all));
  geometric::replace_file(folder / "report.md", to_markdown(document));
  geometric::replace_file(folder / "report.html", to_html(document));
  geometric::replace_file(folder / "report.csv", to_csv(csv));
}

}  // namespace handway::tools
