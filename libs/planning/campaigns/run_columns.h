#pragma once

#include "handway/planning/campaigns/run_record.h"

#include <array>
#include <string_view>
#include <variant>

namespace handway::planning {

/// Where a RunRecord keeps a number or a text that is a column of the run database.
using RunField = std::variant<std::uint64_t RunRecord::*, double RunRecord::*, bool RunRecord::*,
                              std::string RunRecord::*>;

struct RunColumn {
  std::string_view name;
  RunField field;
};

/// The columns of a run in the order of the table, after problem, planner and seed;
/// `nodes_per_pmds` (JSON) and `path` follow.
inline constexpr std::array<RunColumn, 21> kRunColumns = {{
    {"solved", &RunRecord::solved},
    {"status", &RunRecord::status},
    {"reason", &RunRecord::reason},
    {"time_s", &RunRecord::time_s},
    {"smoothing_s", &RunRecord::smoothing_s},
    {"sampling_s", &RunRecord::sampling_s},
    {"connection_s", &RunRecord::connection_s},
    {"samples", &RunRecord::samples},
    {"nodes", &RunRecord::nodes},
    {"edges", &RunRecord::edges},
    {"passes", &RunRecord::passes},
    {"max_trials", &RunRecord::max_trials},
    {"final_rho_a", &RunRecord::final_rho_a},
    {"node_checks", &RunRecord::node_checks},
    {"edge_checks", &RunRecord::edge_checks},
    {"edges_tested", &RunRecord::edges_tested},
    {"path_nodes", &RunRecord::path_nodes},
    {"path_length", &RunRecord::path_length},
    {"resolution_mm", &RunRecord::resolution_mm},
    {"min_clearance_mm", &RunRecord::min_clearance_mm},
    {"certificate_checks", &RunRecord::certificate_checks},
}};

}  // namespace handway::planning
