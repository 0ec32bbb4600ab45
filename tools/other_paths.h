#pragma once

#include "handway/planning/campaigns/campaign.h"
#include "handway/planning/campaigns/run_workers.h"

#include <filesystem>
#include <string>
#include <vector>

namespace handway::tools {

/// Paths of other planners on the problems of a campaign, checked on the exact meshes.
struct OtherPaths {
  std::vector<std::string> planners;         ///< Names by index of a record's planner.
  std::vector<planning::RunRecord> records;  ///< The planners' indices count from 0.
  std::vector<std::string> skipped;          ///< Files or rows that were not checked, and why.
};

/// Reads paths of other planners and checks each with planning::check_again(), on all cores.
///
/// `paths` is a table with a header: the columns `problem`, the joints (rad, m), and optionally
/// `planner`, `seed` and `time_s`; rows are waypoints, and consecutive rows of the same problem,
/// planner and seed are a path. Or it is a folder with a file for each path, in any format of
/// planning::read_path(): `PLANNER/PROBLEM.csv`, or `PROBLEM.csv` for one planner with the folder's
/// name.
/// @throws InputError if `paths` can't be read, or holds no path of a problem of the campaign.
[[nodiscard]] OtherPaths read_other_paths(const std::filesystem::path& paths,
                                          const planning::RunExecutor& executor);

}  // namespace handway::tools
