#pragma once

#include <string>

namespace handway::planning {

/// Marks the files of this program (SQLite's application_id): "HWAY".
inline constexpr int kRunDatabaseId = 0x48574159;
/// SQLite's user_version; raised with every change of the tables.
inline constexpr int kRunDatabaseVersion = 1;

/// The statements that make the tables and the view.
[[nodiscard]] std::string run_schema();
/// Adds a run; parameters: problem, planner, seed, version, then kRunColumns,
/// nodes_per_pmds and path. A run that is there stays.
[[nodiscard]] std::string insert_run();
/// All runs without their paths: problem, planner, seed, then kRunColumns and nodes_per_pmds.
[[nodiscard]] std::string select_runs();

}  // namespace handway::planning
