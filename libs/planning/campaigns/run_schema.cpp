#include "campaigns/run_schema.h"

#include "campaigns/run_columns.h"

#include <fmt/format.h>

#include <type_traits>

namespace handway::planning {
namespace {

const char* type_of(const RunField& field) {
  return std::visit(
      [](const auto member) {
        using Value = std::decay_t<decltype(std::declval<RunRecord>().*member)>;
        if constexpr (std::is_same_v<Value, double>) {
          return "REAL";
        } else if constexpr (std::is_same_v<Value, std::string>) {
          return "TEXT";
        } else {
          return "INTEGER";
        }
      },
      field);
}

std::string column_names() {
  std::string names;
  for (const RunColumn& column : kRunColumns) {
    names += fmt::format("{}, ", column.name);
  }
  return names;
}

}  // namespace

std::string run_schema() {
  std::string columns;
  for (const RunColumn& column : kRunColumns) {
    columns += fmt::format("  {} {} NOT NULL,\n", column.name, type_of(column.field));
  }
  return fmt::format(
      "PRAGMA application_id = {};\n"
      "PRAGMA user_version = {};\n"
      "CREATE TABLE setting (key TEXT PRIMARY KEY, value TEXT NOT NULL);\n"
      "CREATE TABLE problem (\n"
      "  id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE, file TEXT NOT NULL,\n"
      "  digest TEXT NOT NULL);\n"
      "CREATE TABLE planner (\n"
      "  id INTEGER PRIMARY KEY, label TEXT NOT NULL, planner TEXT NOT NULL,\n"
      "  parameters TEXT NOT NULL, UNIQUE (planner, parameters));\n"
      "CREATE TABLE run (\n"
      "  problem INTEGER NOT NULL REFERENCES problem (id),\n"
      "  planner INTEGER NOT NULL REFERENCES planner (id),\n"
      "  seed INTEGER NOT NULL,\n"
      "  version TEXT NOT NULL,\n"
      "{}"
      "  nodes_per_pmds TEXT NOT NULL,\n"
      "  path TEXT NOT NULL,\n"
      "  PRIMARY KEY (problem, planner, seed)) WITHOUT ROWID;\n"
      "CREATE VIEW runs AS SELECT problem.name AS problem, planner.label AS planner, seed,\n"
      "  {} nodes_per_pmds, path, version FROM run\n"
      "  JOIN problem ON problem.id = run.problem JOIN planner ON planner.id = run.planner;\n",
      kRunDatabaseId, kRunDatabaseVersion, columns, column_names());
}

std::string insert_run() {
  std::string marks = "?, ?, ?, ?";
  for (std::size_t i = 0; i < kRunColumns.size() + 2; ++i) {
    marks += ", ?";
  }
  return fmt::format(
      "INSERT INTO run (problem, planner, seed, version, {} nodes_per_pmds, path) "
      "VALUES ({}) ON CONFLICT DO NOTHING",
      column_names(), marks);
}

std::string select_runs() {
  return fmt::format("SELECT problem, planner, seed, {} nodes_per_pmds FROM run", column_names());
}

}  // namespace handway::planning
