#include "campaign_report.h"
#include "machine.h"
#include "version.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>

namespace handway::tools {
namespace {

using planning::Campaign;
using planning::CampaignCell;
using planning::RunRecord;

// OMPL's names of the results of a run, in the order of ompl::base::PlannerStatus.
constexpr const char* kStatuses =
    "status|Unknown status|Invalid start|Invalid goal|Unrecognized goal type|Timeout|"
    "Approximate solution|Exact solution|Crash|Abort";

int status_number(const RunRecord& run) {
  if (run.solved) {
    return 6;
  }
  const std::array<std::pair<const char*, int>, 5> numbers = {{{"start invalid", 1},
                                                               {"goal invalid", 2},
                                                               {"time limit", 4},
                                                               {"samples spent", 4},
                                                               {"stalled", 4}}};
  const auto* found = std::ranges::find(numbers, run.status,
                                        [](const auto& pair) { return std::string(pair.first); });
  return found == numbers.end() ? 0 : found->second;
}

struct Property {
  const char* name;  ///< With its type, as in the log.
  double (*value)(const RunRecord&);
};

double real(std::uint64_t value) { return static_cast<double>(value); }

constexpr std::array<Property, 12> kProperties = {{
    {"solved BOOLEAN", [](const RunRecord& r) { return r.solved ? 1.0 : 0.0; }},
    {"status ENUM", [](const RunRecord& r) { return static_cast<double>(status_number(r)); }},
    {"time REAL", [](const RunRecord& r) { return r.time_s; }},
    {"simplification time REAL", [](const RunRecord& r) { return r.smoothing_s; }},
    {"samples INTEGER", [](const RunRecord& r) { return real(r.samples); }},
    {"graph states INTEGER", [](const RunRecord& r) { return real(r.nodes); }},
    {"graph motions INTEGER", [](const RunRecord& r) { return real(r.edges); }},
    {"states checked INTEGER",
     [](const RunRecord& r) { return real(r.node_checks + r.edge_checks); }},
    {"motions checked INTEGER", [](const RunRecord& r) { return real(r.edges_tested); }},
    {"solution segments INTEGER", [](const RunRecord& r) { return real(r.path_nodes) - 1.0; }},
    {"solution length REAL", [](const RunRecord& r) { return r.path_length; }},
    {"solution clearance REAL", [](const RunRecord& r) { return r.min_clearance; }},
}};

bool of_solution(const Property& property) {
  return std::string_view(property.name).starts_with("solution") ||
         std::string_view(property.name).starts_with("simplification");
}

std::string run_line(const RunRecord& run) {
  std::string line = fmt::format("{}; ", run.spec.seed);
  for (const Property& property : kProperties) {
    line += of_solution(property) && !run.solved ? "; " : fmt::format("{}; ", property.value(run));
  }
  return line + "\n";
}

// Removes quotes, bars and ends of lines, which the log's readers would interpret.
std::string plain(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == '"' || c == '`' || c == '|' || c == '\n' || c == '\''; }, '_');
  return text;
}

double time_spent(std::span<const CampaignCell> cells) {
  double seconds = 0.0;
  for (const CampaignCell& cell : cells) {
    for (const RunRecord& run : cell.runs) {
      seconds += run.time_s + run.smoothing_s;
    }
  }
  return seconds;
}

}  // namespace

std::string ompl_log(const Campaign& campaign, std::span<const CampaignCell> cells) {
  const auto& problem = campaign.problems[static_cast<std::size_t>(cells.front().problem)];
  std::string name = plain(problem.name);
  std::ranges::replace(name, ' ', '_');
  std::string log = fmt::format(
      "Handway version {}\nExperiment {}\nRunning on {}\nStarting at {}\n", kVersion, name,
      host_name(), fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::localtime(std::time(nullptr))));
  log += fmt::format("<<<|\n{}: {}\n|>>>\n", plain(campaign.name), plain(problem.file.string()));
  log += fmt::format("<<<|\n{}\n|>>>\n", plain(processor_name()));
  log += fmt::format(
      "{} is the random seed\n{} seconds per run\n0 MB per run\n{} runs per planner\n"
      "{} seconds spent to collect the data\n1 enum type\n{}\n{} planners\n",
      campaign.seeds.front(), campaign.time_limit_s, campaign.seeds.size(), time_spent(cells),
      kStatuses, cells.size());
  for (const CampaignCell& cell : cells) {
    const auto& planner = campaign.planners[static_cast<std::size_t>(cell.planner)];
    log +=
        fmt::format("{}\n{} common properties\n", plain(planner.label), planner.parameters.size());
    for (const auto& [key, value] : planner.parameters) {
      const bool number = value.find_first_not_of("0123456789.e+-") == std::string::npos;
      log += fmt::format("{} {} = {}\n", key, number ? "REAL" : "VARCHAR(128)", value);
    }
    log += fmt::format("{} properties for each run\nseed INTEGER\n", kProperties.size() + 1);
    for (const Property& property : kProperties) {
      log += fmt::format("{}\n", property.name);
    }
    log += fmt::format("{} runs\n", cell.runs.size());
    for (const RunRecord& run : cell.runs) {
      log += run_line(run);
    }
    log += ".\n";
  }
  return log;
}

}  // namespace handway::tools
