#include "handway/planning/campaigns/run_database.h"

#include "handway/geometric/io/disk_cache.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/math/units.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <SQLiteCpp/VariadicBind.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sqlite3.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <system_error>
#include <tuple>
#include <type_traits>
#include <utility>

namespace handway::planning {
namespace {

namespace fs = std::filesystem;
using geometric::InputError;
using SQLite::Statement;

/// Marks the files of this program (SQLite's application_id): "HWAY".
constexpr int kApplicationId = 0x48574159;
/// SQLite's user_version; raised with every change of the tables.
constexpr int kSchemaVersion = 2;
constexpr int kBusyTimeout = 2000;  // ms, while another program writes
constexpr const char* kResumeAdvice =
    "Free disk space or correct the problem, and continue with --resume: finished runs are kept";

/// Calls `use` with name and value of each field of `record` that is a column of the run database,
/// in the order of the table: after problem, planner, seed and version; `nodes_per_pmds` (JSON) and
/// `path` follow.
template <typename Record, typename Use>
void for_each_field(Record& record, const Use& use) {
  const auto use_in_millimetres = [&use](std::string_view name, auto& metres) {
    double millimetres = geometric::millimetres(metres);
    use(name, millimetres);
    if constexpr (!std::is_const_v<std::remove_reference_t<decltype(metres)>>) {
      metres = geometric::metres(millimetres);
    }
  };
  use("solved", record.solved);
  use("status", record.status);
  use("reason", record.reason);
  use("time_s", record.time_s);
  use("smoothing_s", record.smoothing_s);
  use("sampling_s", record.sampling_s);
  use("connection_s", record.connection_s);
  use("samples", record.samples);
  use("nodes", record.nodes);
  use("edges", record.edges);
  use("passes", record.passes);
  use("max_trials", record.max_trials);
  use("final_rho_a", record.final_rho_a);
  use("node_checks", record.node_checks);
  use("edge_checks", record.edge_checks);
  use("edges_tested", record.edges_tested);
  use("path_nodes", record.path_nodes);
  use("path_length", record.path_length);
  use_in_millimetres("resolution_mm", record.resolution);
  use_in_millimetres("min_clearance_mm", record.min_clearance);
  use("certificate_checks", record.certificate_checks);
  use("cpu_s", record.cpu_s);
  use("l2_length", record.l2_length);
  use("is_checked", record.is_checked);
  use("fault", record.fault);
  use("to_subspace", record.measures.to_subspace);
  use("hand_sparc", record.measures.hand_sparc);
  use("palm_sparc", record.measures.palm_sparc);
  use("arm_deviation", record.measures.arm_deviation);
}

/// Returns `text` for each of them.
std::string for_columns(const std::function<std::string(std::string_view name)>& text) {
  std::string all;
  const RunRecord record;
  for_each_field(record, [&](std::string_view name, const auto&) { all += text(name); });
  return all;
}

std::string column_names() {
  return for_columns([](std::string_view name) { return fmt::format("{}, ", name); });
}

/// The statements that make the tables and the view.
std::string run_schema() {
  std::string columns;
  const RunRecord record;
  for_each_field(record, [&](std::string_view name, const auto& value) {
    using Value = std::decay_t<decltype(value)>;
    columns += fmt::format("  {} {},\n", name,
                           std::is_same_v<Value, double>        ? "REAL"  // NaN is NULL
                           : std::is_same_v<Value, std::string> ? "TEXT NOT NULL"
                                                                : "INTEGER NOT NULL");
  });
  return fmt::format(
      "PRAGMA application_id = {};\n"
      "PRAGMA user_version = {};\n"
      "CREATE TABLE setting (key TEXT PRIMARY KEY, value TEXT NOT NULL);\n"
      "CREATE TABLE problem (\n"
      "  id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE, file TEXT NOT NULL,\n"
      "  digest TEXT NOT NULL, tags TEXT NOT NULL);\n"
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
      kApplicationId, kSchemaVersion, columns, column_names());
}

/// Adds a run; parameters: problem, planner, seed, version, then all fields, nodes_per_pmds and
/// path. An existing run stays.
std::string insert_run() {
  return fmt::format(
      "INSERT INTO run (problem, planner, seed, version, {} nodes_per_pmds, path) "
      "VALUES (?, ?, ?, ?, {} ?, ?) ON CONFLICT DO NOTHING",
      column_names(), for_columns([](std::string_view) { return "?, "; }));
}

void bind_fields(Statement& insert, int at, const RunRecord& record) {
  for_each_field(record, [&](std::string_view /*name*/, const auto& value) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, std::string>) {
      insert.bind(at++, value);
    } else {
      insert.bind(at++, static_cast<std::int64_t>(value));
    }
  });
  insert.bind(at++, nlohmann::json(record.nodes_per_pmds).dump());
  insert.bind(at, record.path);
}

/// A record without spec and path, from all fields and nodes_per_pmds, which begin at column `at`.
RunRecord record_in(const Statement& row, int at) {
  RunRecord record;
  for_each_field(record, [&](std::string_view /*name*/, auto& value) {
    using Value = std::decay_t<decltype(value)>;
    const SQLite::Column column = row.getColumn(at++);
    if constexpr (std::is_same_v<Value, double>) {
      value = column.isNull() ? std::numeric_limits<double>::quiet_NaN() : column.getDouble();
    } else if constexpr (std::is_same_v<Value, std::string>) {
      value = column.getString();
    } else {
      value = static_cast<Value>(column.getInt64());
    }
  });
  record.nodes_per_pmds =
      nlohmann::json::parse(row.getColumn(at).getString()).get<std::vector<std::uint64_t>>();
  return record;
}

std::uint64_t seed_in(const Statement& row, int at) {
  return static_cast<std::uint64_t>(row.getColumn(at).getInt64());
}

/// Locks a folder for this program during its lifetime; the system releases the lock of a killed
/// program.
class FolderLock {
 public:
  /// @throws InputError if another program holds it, OutputError if the folder can't be opened.
  explicit FolderLock(const fs::path& folder)
      : descriptor_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (descriptor_ < 0) {
      throw geometric::OutputError({folder.string(), "", std::strerror(errno), "a folder for runs",
                                    "Choose another folder"});
    }
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      close(descriptor_);
      throw InputError({folder.string(), "", "a campaign that is running there",
                        "a folder that no other program uses",
                        "Wait until it is done, or choose another folder"});
    }
  }
  ~FolderLock() { close(descriptor_); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

/// Does `work` on the database in `file`. @throws InputError for a file that is no database,
/// OutputError for other exceptions of SQLite.
template <typename Work>
auto on_database(const fs::path& file, const Work& work) {
  try {
    return work();
  } catch (const SQLite::Exception& error) {
    if (error.getErrorCode() == SQLITE_NOTADB || error.getErrorCode() == SQLITE_CORRUPT) {
      throw InputError({file.string(), "", "a file of another format", "a run database",
                        "Choose another folder"});
    }
    throw geometric::OutputError(
        {file.string(), "", error.what(), "a run database that can be written", kResumeAdvice});
  }
}

/// Digests of files that many problems share, each computed once.
class Digests {
 public:
  /// Returns a line for each file of a problem: its digest and its path.
  std::string of(const CampaignProblem& problem) {
    std::string lines = line(fs::absolute(problem.file).lexically_normal());
    for (const fs::path& file : problem.files) {
      const std::string& next = line(file);
      lines += lines.starts_with(next) ? "" : next;
    }
    return lines;
  }

 private:
  const std::string& line(const fs::path& file) {
    std::string& line = lines_[file];
    if (line.empty()) {
      line = fmt::format("{} {}\n", geometric::digest_of_file(file), file.string());
    }
    return line;
  }

  std::map<fs::path, std::string> lines_;
};

// Returns the first line that differs between two descriptions.
std::string first_difference(const std::string& before, const std::string& now) {
  std::istringstream old_lines(before);
  std::istringstream new_lines(now);
  std::string old_line;
  std::string new_line;
  while (std::getline(new_lines, new_line)) {
    if (!std::getline(old_lines, old_line) || old_line != new_line) {
      return new_line.substr(new_line.find(' ') + 1);
    }
  }
  return old_line.substr(old_line.find(' ') + 1);
}

// @param entries texts by keys.
std::string json_of(const std::vector<std::pair<std::string, std::string>>& entries) {
  auto json = nlohmann::ordered_json::object();
  for (const auto& [key, value] : entries) {
    json[key] = value;
  }
  return json.dump();
}

ParameterTexts parameters_in(const std::string& text) {
  ParameterTexts parameters;
  const auto json = nlohmann::ordered_json::parse(text);
  for (const auto& [key, value] : json.items()) {
    parameters.emplace_back(key, value.get<std::string>());
  }
  return parameters;
}

using Key = std::tuple<std::int64_t, std::int64_t, std::uint64_t>;

// Reads the key of a row that begins with problem, planner and seed.
Key key_in(const Statement& row) {
  return {row.getColumn(0).getInt64(), row.getColumn(1).getInt64(), seed_in(row, 2)};
}

}  // namespace

struct RunDatabase::Connection {
  explicit Connection(const fs::path& path)
      : lock(fs::absolute(path).parent_path()),
        file(path),
        database(path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE) {}

  void prepare(Opening opening);
  void keep_setting(const char* key, const std::string& value);
  std::int64_t problem_id(const CampaignProblem& problem);
  std::int64_t planner_id(const CampaignPlanner& planner);
  [[nodiscard]] Key key_of(const RunSpec& spec) const {
    return {problems[static_cast<std::size_t>(spec.problem)],
            planners[static_cast<std::size_t>(spec.planner)], spec.seed};
  }

  /// Carries out a statement with these parameters. @returns the row that it added.
  template <typename... Values>
  std::int64_t insert(const char* statement, const Values&... values) {
    Statement query(database, statement);
    SQLite::bind(query, values...);
    query.exec();
    return database.getLastInsertRowid();
  }

  FolderLock lock;
  fs::path file;
  SQLite::Database database;
  Digests digests;
  std::vector<std::int64_t> problems;  ///< Ids, by the campaign's index.
  std::vector<std::int64_t> planners;
};

void RunDatabase::Connection::prepare(Opening opening) {
  database.exec("PRAGMA journal_mode = WAL");
  database.exec("PRAGMA synchronous = FULL");  // a run that was added survives a power cut
  database.exec("PRAGMA foreign_keys = ON");
  const int id = database.execAndGet("PRAGMA application_id").getInt();
  const int version = database.execAndGet("PRAGMA user_version").getInt();
  if (id == 0 && version == 0 &&
      database.execAndGet("SELECT count(*) FROM sqlite_master").getInt() == 0) {
    SQLite::Transaction transaction(database);
    database.exec(run_schema());
    transaction.commit();
    return;
  }
  if (id != kApplicationId || version != kSchemaVersion) {
    throw InputError({file.string(), "",
                      id != kApplicationId ? "a database of another program"
                                           : "runs of another version of Handway",
                      "a run database", "Choose another folder"});
  }
  const int runs = database.execAndGet("SELECT count(*) FROM run").getInt();
  if (opening == Opening::kNew && runs > 0) {
    throw InputError({file.string(), "", fmt::format("{} runs", runs), "a folder without runs",
                      "Continue them with --resume, or choose another folder"});
  }
}

void RunDatabase::Connection::keep_setting(const char* key, const std::string& value) {
  Statement query(database, "SELECT value FROM setting WHERE key = ?");
  query.bind(1, key);
  if (!query.executeStep()) {
    insert("INSERT INTO setting (key, value) VALUES (?, ?)", key, value);
  } else if (const std::string kept = query.getColumn(0).getString(); kept != value) {
    throw InputError({file.string(), key, fmt::format("runs made with {}", kept),
                      fmt::format("{}, as the campaign says", value),
                      "Choose another folder, or correct the campaign"});
  }
}

std::int64_t RunDatabase::Connection::problem_id(const CampaignProblem& problem) {
  const std::string digest = digests.of(problem);
  Statement query(database, "SELECT id, digest FROM problem WHERE name = ?");
  query.bind(1, problem.name);
  if (!query.executeStep()) {
    return insert("INSERT INTO problem (name, file, digest, tags) VALUES (?, ?, ?, ?)",
                  problem.name, problem.file.string(), digest, json_of(problem.tags));
  }
  if (const std::string kept = query.getColumn(1).getString(); kept != digest) {
    throw InputError({file.string(), fmt::format("problem \"{}\"", problem.name),
                      "runs of another or an older file",
                      fmt::format("runs of {} as it is now", first_difference(kept, digest)),
                      "Choose another folder, or give the problem another name"});
  }
  return query.getColumn(0).getInt64();
}

std::int64_t RunDatabase::Connection::planner_id(const CampaignPlanner& planner) {
  const std::string parameters = json_of(planner.parameters);
  Statement query(database, "SELECT id FROM planner WHERE planner = ? AND parameters = ?");
  SQLite::bind(query, planner.planner, parameters);
  if (query.executeStep()) {
    return query.getColumn(0).getInt64();
  }
  return insert("INSERT INTO planner (label, planner, parameters) VALUES (?, ?, ?)", planner.label,
                planner.planner, parameters);
}

RunDatabase::RunDatabase(const fs::path& file, const Campaign& campaign, std::string version,
                         Opening opening)
    : campaign_(campaign), version_(std::move(version)) {
  on_database(file, [&] {
    connection_ = std::make_unique<Connection>(file);
    connection_->prepare(opening);
    SQLite::Transaction transaction(connection_->database);
    connection_->keep_setting("time_limit_s", fmt::format("{}", campaign_.time_limit_s));
    connection_->keep_setting("threads", fmt::format("{}", campaign_.threads));
    connection_->keep_setting("check_paths", fmt::format("{}", campaign_.check_paths));
    connection_->keep_setting("measure_motions", fmt::format("{}", campaign_.measure_motions));
    for (const CampaignProblem& problem : campaign_.problems) {
      connection_->problems.push_back(connection_->problem_id(problem));
    }
    for (const CampaignPlanner& planner : campaign_.planners) {
      connection_->planners.push_back(connection_->planner_id(planner));
    }
    transaction.commit();
  });
}

RunDatabase::~RunDatabase() = default;

std::vector<RunSpec> RunDatabase::pending() const {
  std::set<Key> done;
  on_database(connection_->file, [&] {
    Statement query(connection_->database, "SELECT problem, planner, seed FROM run");
    while (query.executeStep()) {
      done.insert(key_in(query));
    }
  });
  std::vector<RunSpec> runs = campaign_.runs();
  std::erase_if(runs, [&](const RunSpec& run) { return done.contains(connection_->key_of(run)); });
  return runs;
}

void RunDatabase::add(std::span<const RunRecord> records) {
  on_database(connection_->file, [&] {
    SQLite::Transaction transaction(connection_->database);
    Statement insert(connection_->database, insert_run());
    for (const RunRecord& record : records) {
      const auto [problem, planner, seed] = connection_->key_of(record.spec);
      SQLite::bind(insert, problem, planner, static_cast<std::int64_t>(seed), version_);
      bind_fields(insert, 5, record);
      insert.exec();
      insert.reset();
    }
    transaction.commit();
  });
}

std::vector<RunRecord> RunDatabase::records() const {
  std::map<Key, RunRecord> found;
  on_database(connection_->file, [&] {
    Statement query(
        connection_->database,
        fmt::format("SELECT problem, planner, seed, {} nodes_per_pmds FROM run", column_names()));
    while (query.executeStep()) {
      found.emplace(key_in(query), record_in(query, 3));
    }
  });
  std::vector<RunRecord> records;
  for (const RunSpec& run : campaign_.runs()) {
    if (const auto at = found.find(connection_->key_of(run)); at != found.end()) {
      records.push_back(std::move(at->second));
      records.back().spec = run;
    }
  }
  return records;
}

std::vector<std::string> RunDatabase::versions() const {
  std::vector<std::string> versions;
  on_database(connection_->file, [&] {
    Statement query(connection_->database, "SELECT DISTINCT version FROM run ORDER BY version");
    while (query.executeStep()) {
      versions.push_back(query.getColumn(0).getString());
    }
  });
  return versions;
}

std::vector<ArchivedRun> read_runs(const fs::path& file) {
  const auto refuse = [&](const std::string& found) -> InputError {
    return InputError({file.string(), "", found, "a run database of `handway bench`",
                       "Its name is runs.sqlite, in the folder of the campaign"});
  };
  if (std::error_code ignored; !fs::is_regular_file(file, ignored)) {
    throw refuse("no such file");
  }
  try {
    SQLite::Database database(file.string(), SQLite::OPEN_READONLY, kBusyTimeout);
    if (database.execAndGet("PRAGMA application_id").getInt() != kApplicationId) {
      throw refuse("a database of another program");
    }
    if (database.execAndGet("PRAGMA user_version").getInt() != kSchemaVersion) {
      throw refuse("runs of another version of Handway");
    }
    Statement rows(database,
                   fmt::format("SELECT problem.name, problem.file, planner.label, planner.planner, "
                               "planner.parameters, seed, {} nodes_per_pmds FROM run "
                               "JOIN problem ON problem.id = run.problem "
                               "JOIN planner ON planner.id = run.planner "
                               "ORDER BY run.problem, run.planner, seed",
                               column_names()));
    std::vector<ArchivedRun> runs;
    while (rows.executeStep()) {
      const auto text = [&](int column) { return rows.getColumn(column).getString(); };
      runs.push_back(
          {text(0), text(1), {text(2), text(3), parameters_in(text(4))}, record_in(rows, 6)});
      runs.back().record.spec.seed = seed_in(rows, 5);
    }
    return runs;
  } catch (const SQLite::Exception& error) {
    throw refuse(error.what());
  } catch (const nlohmann::json::exception& error) {
    throw refuse(error.what());
  }
}

ArchivedRun archived(const Campaign& campaign, const RunRecord& record) {
  const CampaignProblem& problem = campaign.problems[static_cast<std::size_t>(record.spec.problem)];
  ArchivedRun run{problem.name, problem.file,
                  campaign.planners[static_cast<std::size_t>(record.spec.planner)], record};
  run.record.path.clear();
  return run;
}

}  // namespace handway::planning
