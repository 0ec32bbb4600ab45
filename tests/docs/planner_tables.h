#pragma once

#include "handway/planning/planners/planner.h"

#include <string>

namespace handway::test {

/// Returns for each planner its description, its capabilities and a table of its parameters, in
/// Markdown.
[[nodiscard]] std::string planner_tables(const planning::PlannerRegistry& registry);

/// Returns a table of the settings of each kind of work but planning, in Markdown.
[[nodiscard]] std::string settings_tables();

/// `page` with what stands between the two marks replaced by `tables`.
/// @throws std::runtime_error if a mark is missing.
[[nodiscard]] std::string with_tables(const std::string& page, const std::string& tables);

}  // namespace handway::test
