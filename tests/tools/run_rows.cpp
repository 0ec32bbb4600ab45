#include "run_rows.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <set>

namespace handway::test {

std::vector<std::string> run_rows(const std::filesystem::path& database) {
  const std::set<std::string> times = {"time_s", "smoothing_s", "sampling_s", "connection_s",
                                       "cpu_s",  "reason"};  // which tells the time too
  const SQLite::Database file(database.string());
  SQLite::Statement query(file, "SELECT * FROM runs ORDER BY problem, planner, seed");
  std::vector<std::string> rows;
  while (query.executeStep()) {
    std::string row;
    for (int i = 0; i < query.getColumnCount(); ++i) {
      if (!times.contains(query.getColumnName(i))) {
        row += query.getColumn(i).getString() + '|';
      }
    }
    rows.push_back(row);
  }
  return rows;
}

std::size_t run_count(const std::filesystem::path& database) {
  try {
    const SQLite::Database file(database.string());
    SQLite::Statement query(file, "SELECT count(*) FROM run");
    return query.executeStep() ? static_cast<std::size_t>(query.getColumn(0).getInt64()) : 0;
  } catch (const SQLite::Exception&) {
    return 0;  // not there yet, or not made yet
  }
}

}  // namespace handway::test
