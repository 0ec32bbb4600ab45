#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace handway::test {

/// The rows of a run database, a line each and in order, without what differs from one
/// time to the next: the times.
[[nodiscard]] std::vector<std::string> run_rows(const std::filesystem::path& database);

/// Returns the number of runs; 0 as long as there is no database.
[[nodiscard]] std::size_t run_count(const std::filesystem::path& database);

}  // namespace handway::test
