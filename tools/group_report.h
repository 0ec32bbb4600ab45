#pragma once

#include "campaign_command.h"
#include "handway/report/document/document.h"
#include "handway/report/document/table.h"

namespace handway::tools {

/// Returns a table for each tag of the problems and one for all of them, with a row for each value
/// and planner; nothing if no problem has a tag. Paths of other planners are rows, too.
[[nodiscard]] report::Document group_tables(const CampaignOutcome& outcome);

/// Returns these tables as one, for programs: a row for each tag, value and planner.
[[nodiscard]] report::Table group_table(const CampaignOutcome& outcome);

/// Returns the problems that were left out and the paths of other planners that were not checked,
/// with the reasons; nothing if there are none.
[[nodiscard]] report::Document left_out_tables(const CampaignOutcome& outcome);

/// Returns a row for each path of another planner; without rows if there are none.
[[nodiscard]] report::Table other_paths_table(const CampaignOutcome& outcome);

}  // namespace handway::tools
