#include "handway/planning/campaigns/run_database.h"

#include "campaigns/run_columns.h"
#include "campaigns/run_schema.h"
#include "handway/geometric/io/disk_cache.h"
#include "handway/geometric/io/input_error.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sqlite3.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <system_error>
#include <tuple>
#include <type_traits>

namespace handway::planning {
namespace {

/// Keeps other programs from working in a folder, as long as it lives; the system takes it
/// back from a program that is killed.
class FolderLock {
 public:
  /// @throws InputError if another program holds it, or the folder can't be opened.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

using geometric::InputError;

FolderLock::FolderLock(const std::filesystem::path& folder)
    : descriptor_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0) {
    throw InputError(
        {folder.string(), "", std::strerror(errno), "a folder for runs", "Choose another folder"});
  }
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(descriptor_);
    throw InputError({folder.string(), "", "a campaign that is being run there",
                      "a folder that no other program works in",
                      "Wait until it is done, or choose another folder"});
  }
}

FolderLock::~FolderLock() { close(descriptor_); }

namespace fs = std::filesystem;
using geometric::InputError;
using SQLite::Statement;

constexpr const char* kResumeAdvice =
    "Make room or correct what is wrong, and go on with --resume: the runs done so far are kept";

[[noreturn]] void refuse(const fs::path& file, const SQLite::Exception& error) {
  if (error.getErrorCode() == SQLITE_NOTADB) {
    throw InputError(
        {file.string(), "", "a file of another format", "a run database", "Choose another folder"});
  }
  throw InputError(
      {file.string(), "", error.what(), "a run database that can be written", kResumeAdvice});
}

// A line for each file of a problem: its digest and its path.
std::string digests_of(const CampaignProblem& problem) {
  std::string lines = fmt::format("{} {}\n", geometric::digest_of_file(problem.file),
                                  fs::absolute(problem.file).lexically_normal().string());
  for (const fs::path& file : problem.files) {
    const std::string line = fmt::format("{} {}\n", geometric::digest_of_file(file), file.string());
    lines += lines.starts_with(line) ? "" : line;
  }
  return lines;
}

// What differs first between two such texts.
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

std::string json_of(const ParameterTexts& parameters) {
  auto json = nlohmann::ordered_json::object();
  for (const auto& [key, value] : parameters) {
    json[key] = value;
  }
  return json.dump();
}

using Key = std::tuple<std::int64_t, std::int64_t, std::uint64_t>;

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
  void bind(Statement& insert, const RunRecord& record, const std::string& version) const;
  [[nodiscard]] Key key_of(const RunSpec& spec) const {
    return {problems[static_cast<std::size_t>(spec.problem)],
            planners[static_cast<std::size_t>(spec.planner)], spec.seed};
  }

  FolderLock lock;
  fs::path file;
  SQLite::Database database;
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
  if (id != kRunDatabaseId || version != kRunDatabaseVersion) {
    throw InputError({file.string(), "", "a database of another program or version",
                      "a run database", "Choose another folder"});
  }
  if (opening == Opening::kNew && database.execAndGet("SELECT count(*) FROM run").getInt() > 0) {
    throw InputError(
        {file.string(), "",
         fmt::format("{} runs", database.execAndGet("SELECT count(*) FROM run").getInt()),
         "a folder without runs", "Go on with them with --resume, or choose another folder"});
  }
}

void RunDatabase::Connection::keep_setting(const char* key, const std::string& value) {
  Statement query(database, "SELECT value FROM setting WHERE key = ?");
  query.bind(1, key);
  if (query.executeStep()) {
    const std::string kept = query.getColumn(0).getString();
    if (kept != value) {
      throw InputError({file.string(), key, fmt::format("runs made with {}", kept),
                        fmt::format("{}, as the campaign says", value),
                        "Choose another folder, or correct the campaign"});
    }
    return;
  }
  Statement insert(database, "INSERT INTO setting (key, value) VALUES (?, ?)");
  insert.bind(1, key);
  insert.bind(2, value);
  insert.exec();
}

std::int64_t RunDatabase::Connection::problem_id(const CampaignProblem& problem) {
  const std::string digest = digests_of(problem);
  Statement query(database, "SELECT id, digest FROM problem WHERE name = ?");
  query.bind(1, problem.name);
  if (query.executeStep()) {
    if (const std::string kept = query.getColumn(1).getString(); kept != digest) {
      throw InputError({file.string(), fmt::format("problem \"{}\"", problem.name),
                        "runs of another or an older file",
                        fmt::format("runs of {} as it is now", first_difference(kept, digest)),
                        "Choose another folder, or give the problem another name"});
    }
    return query.getColumn(0).getInt64();
  }
  Statement insert(database, "INSERT INTO problem (name, file, digest) VALUES (?, ?, ?)");
  insert.bind(1, problem.name);
  insert.bind(2, problem.file.string());
  insert.bind(3, digest);
  insert.exec();
  return database.getLastInsertRowid();
}

std::int64_t RunDatabase::Connection::planner_id(const CampaignPlanner& planner) {
  const std::string parameters = json_of(planner.parameters);
  Statement query(database, "SELECT id FROM planner WHERE planner = ? AND parameters = ?");
  query.bind(1, planner.planner);
  query.bind(2, parameters);
  if (query.executeStep()) {
    return query.getColumn(0).getInt64();
  }
  Statement insert(database, "INSERT INTO planner (label, planner, parameters) VALUES (?, ?, ?)");
  insert.bind(1, planner.label);
  insert.bind(2, planner.planner);
  insert.bind(3, parameters);
  insert.exec();
  return database.getLastInsertRowid();
}

void RunDatabase::Connection::bind(Statement& insert, const RunRecord& record,
                                   const std::string& version) const {
  const auto [problem, planner, seed] = key_of(record.spec);
  int at = 0;
  insert.bind(++at, problem);
  insert.bind(++at, planner);
  insert.bind(++at, static_cast<std::int64_t>(seed));
  insert.bind(++at, version);
  for (const RunColumn& column : kRunColumns) {
    ++at;
    std::visit(
        [&](const auto member) {
          using Value = std::decay_t<decltype(record.*member)>;
          if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, std::string>) {
            insert.bind(at, record.*member);
          } else {
            insert.bind(at, static_cast<std::int64_t>(record.*member));
          }
        },
        column.field);
  }
  insert.bind(++at, nlohmann::json(record.nodes_per_pmds).dump());
  insert.bind(++at, record.path);
}

RunDatabase::RunDatabase(const fs::path& file, const Campaign& campaign, std::string version,
                         Opening opening)
    : campaign_(campaign), version_(std::move(version)) {
  try {
    connection_ = std::make_unique<Connection>(file);
    connection_->prepare(opening);
    SQLite::Transaction transaction(connection_->database);
    connection_->keep_setting("time_limit_s", fmt::format("{}", campaign_.time_limit_s));
    connection_->keep_setting("threads", fmt::format("{}", campaign_.threads));
    for (const CampaignProblem& problem : campaign_.problems) {
      connection_->problems.push_back(connection_->problem_id(problem));
    }
    for (const CampaignPlanner& planner : campaign_.planners) {
      connection_->planners.push_back(connection_->planner_id(planner));
    }
    transaction.commit();
  } catch (const SQLite::Exception& error) {
    refuse(file, error);
  }
}

RunDatabase::~RunDatabase() = default;

std::vector<RunSpec> RunDatabase::pending() const {
  std::set<Key> done;
  try {
    Statement query(connection_->database, "SELECT problem, planner, seed FROM run");
    while (query.executeStep()) {
      done.emplace(query.getColumn(0).getInt64(), query.getColumn(1).getInt64(),
                   static_cast<std::uint64_t>(query.getColumn(2).getInt64()));
    }
  } catch (const SQLite::Exception& error) {
    refuse(connection_->file, error);
  }
  std::vector<RunSpec> runs = campaign_.runs();
  std::erase_if(runs, [&](const RunSpec& run) { return done.contains(connection_->key_of(run)); });
  return runs;
}

void RunDatabase::add(std::span<const RunRecord> records) {
  try {
    SQLite::Transaction transaction(connection_->database);
    Statement insert(connection_->database, insert_run());
    for (const RunRecord& record : records) {
      connection_->bind(insert, record, version_);
      insert.exec();
      insert.reset();
    }
    transaction.commit();
  } catch (const SQLite::Exception& error) {
    refuse(connection_->file, error);
  }
}

std::vector<RunRecord> RunDatabase::records() const {
  std::map<Key, RunRecord> found;
  try {
    Statement query(connection_->database, select_runs());
    while (query.executeStep()) {
      RunRecord record;
      int at = 3;
      for (const RunColumn& column : kRunColumns) {
        std::visit(
            [&](const auto member) {
              using Value = std::decay_t<decltype(record.*member)>;
              const SQLite::Column value = query.getColumn(at);
              if constexpr (std::is_same_v<Value, double>) {
                record.*member = value.getDouble();
              } else if constexpr (std::is_same_v<Value, std::string>) {
                record.*member = value.getString();
              } else {
                record.*member = static_cast<Value>(value.getInt64());
              }
            },
            column.field);
        ++at;
      }
      record.nodes_per_pmds =
          nlohmann::json::parse(query.getColumn(at).getString()).get<std::vector<std::uint64_t>>();
      found.emplace(Key{query.getColumn(0).getInt64(), query.getColumn(1).getInt64(),
                        static_cast<std::uint64_t>(query.getColumn(2).getInt64())},
                    std::move(record));
    }
  } catch (const SQLite::Exception& error) {
    refuse(connection_->file, error);
  }
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
  try {
    Statement query(connection_->database, "SELECT DISTINCT version FROM run ORDER BY version");
    while (query.executeStep()) {
      versions.push_back(query.getColumn(0).getString());
    }
  } catch (const SQLite::Exception& error) {
    refuse(connection_->file, error);
  }
  return versions;
}

}  // namespace handway::planning
