#pragma once

#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/export.h"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace handway::planning {

/// The runs of a campaign in an SQLite file: every run at most once. Once add() has returned they
/// survive any failure of the program or the machine.
///
/// Tables: `setting` (key, value), `problem` (name, file, digest, tags as JSON), `planner` (label,
/// planner, parameters as JSON) and `run`, one row per run with the fields of RunRecord, problem
/// and planner by id; a view `runs` has names instead. docs/campaigns.md shows them.
///
/// For one thread at a time, one object per file: a lock beside it keeps other programs out
/// meanwhile.
class HANDWAY_PLANNING_EXPORT RunDatabase {
 public:
  enum class Opening {
    kNew,     ///< Refuse a file that holds runs.
    kResume,  ///< Continue a file, or create it.
  };

  /// Opens or creates `file` for the runs of `campaign`. It may hold other runs: those of other
  /// seeds, problems or parameters stay untouched.
  /// @param campaign as RunExecutor::campaign() gives it, with all files of its problems.
  /// @param version of the program, kept with each run.
  /// @throws InputError if the file can't be written, is another program's, is in use, or
  /// holds runs of problems of other files, threads, time limit or measures under the same names.
  RunDatabase(const std::filesystem::path& file, const Campaign& campaign, std::string version,
              Opening opening);
  ~RunDatabase();
  RunDatabase(const RunDatabase&) = delete;
  RunDatabase& operator=(const RunDatabase&) = delete;

  /// The campaign's missing runs, in the campaign's order.
  [[nodiscard]] std::vector<RunSpec> pending() const;

  /// Adds runs in one transaction: all or none. Existing runs stay as they are.
  /// @throws InputError if it can't be written (a full disk); nothing is then added.
  void add(std::span<const RunRecord> records);

  /// The campaign's runs in the file, in the campaign's order, without their paths.
  [[nodiscard]] std::vector<RunRecord> records() const;

  /// The versions of the program that made them.
  [[nodiscard]] std::vector<std::string> versions() const;

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
  const Campaign campaign_;
  std::string version_;
};

/// A run with all data to carry it out again.
struct ArchivedRun {
  std::string problem;  ///< Its name in the campaign.
  std::filesystem::path file;
  CampaignPlanner planner;
  RunRecord record;  ///< Without its path; only the seed of its spec is valid.
};

/// All runs of a run database, in the order of problems, planners and seeds. Another program may be
/// adding runs.
/// @throws InputError if it can't be read or is another file.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<ArchivedRun> read_runs(
    const std::filesystem::path& file);

/// Converts the record of a new run.
[[nodiscard]] HANDWAY_PLANNING_EXPORT ArchivedRun archived(const Campaign& campaign,
                                                           const RunRecord& record);

}  // namespace handway::planning
