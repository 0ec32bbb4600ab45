#include "handway/planning/campaigns/run_archive.h"

#include "campaigns/run_schema.h"
#include "handway/geometric/io/input_error.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <nlohmann/json.hpp>

#include <system_error>

namespace handway::planning {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;

constexpr int kBusyTimeout = 2000;  // ms, while another program writes

[[noreturn]] void refuse(const fs::path& file, const std::string& found) {
  throw InputError({file.string(), "", found, "a run database of `handway bench`",
                    "It is called runs.sqlite, in the folder of the campaign"});
}

ParameterTexts parameters_of(const std::string& text) {
  ParameterTexts parameters;
  const auto json = nlohmann::ordered_json::parse(text);
  for (const auto& [key, value] : json.items()) {
    parameters.emplace_back(key, value.get<std::string>());
  }
  return parameters;
}

ArchivedRun run_of(SQLite::Statement& row) {
  ArchivedRun run;
  int column = 0;
  run.problem = row.getColumn(column++).getString();
  run.file = row.getColumn(column++).getString();
  run.planner.label = row.getColumn(column++).getString();
  run.planner.planner = row.getColumn(column++).getString();
  run.planner.parameters = parameters_of(row.getColumn(column++).getString());
  run.seed = static_cast<std::uint64_t>(row.getColumn(column++).getInt64());
  run.solved = row.getColumn(column++).getInt() != 0;
  run.status = row.getColumn(column++).getString();
  run.time_s = row.getColumn(column++).getDouble();
  run.samples = static_cast<std::uint64_t>(row.getColumn(column++).getInt64());
  run.path_nodes = static_cast<std::uint64_t>(row.getColumn(column++).getInt64());
  run.min_clearance_mm = row.getColumn(column++).getDouble();
  return run;
}

}  // namespace

std::vector<ArchivedRun> read_runs(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) {
    refuse(file, "no such file");
  }
  try {
    const SQLite::Database database(file.string(), SQLite::OPEN_READONLY, kBusyTimeout);
    if (SQLite::Statement id(database, "PRAGMA application_id");
        !id.executeStep() || id.getColumn(0).getInt() != kRunDatabaseId) {
      refuse(file, "a database of another program");
    }
    SQLite::Statement rows(
        database,
        "SELECT problem.name, problem.file, planner.label, planner.planner, planner.parameters, "
        "seed, solved, status, time_s, samples, path_nodes, min_clearance_mm FROM run "
        "JOIN problem ON problem.id = run.problem JOIN planner ON planner.id = run.planner "
        "ORDER BY run.problem, run.planner, seed");
    std::vector<ArchivedRun> runs;
    while (rows.executeStep()) {
      runs.push_back(run_of(rows));
    }
    return runs;
  } catch (const SQLite::Exception& error) {
    refuse(file, error.what());
  } catch (const nlohmann::json::exception& error) {
    refuse(file, error.what());
  }
}

ArchivedRun archived(const Campaign& campaign, const RunRecord& record) {
  const CampaignProblem& problem = campaign.problems[static_cast<std::size_t>(record.spec.problem)];
  return {problem.name,
          problem.file,
          campaign.planners[static_cast<std::size_t>(record.spec.planner)],
          record.spec.seed,
          record.solved,
          record.status,
          record.time_s,
          record.samples,
          record.path_nodes,
          record.min_clearance_mm};
}

}  // namespace handway::planning
