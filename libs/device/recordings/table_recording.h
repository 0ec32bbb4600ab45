#pragma once

#include "handway/device/glove/recording.h"
#include "recordings/number_table.h"
#include "recordings/table_layout.h"

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

/// Recordings made from tables of postures whose layout is known.

namespace handway::device {

/// The times of those rows of a table, made by settle_times(), with its warnings.
[[nodiscard]] std::vector<double> times_of(const std::filesystem::path& file,
                                           const NumberTable& table, const TableLayout& layout,
                                           const std::vector<Eigen::Index>& rows,
                                           std::vector<std::string>& warnings);

/// Rows with gaps are left out, with a warning.
/// @throws InputError naming row and column of a bad value, or if no row is complete.
[[nodiscard]] Recording recording_of(const std::filesystem::path& file, const NumberTable& table,
                                     const TableLayout& layout);

/// Makes a recording whose unit (counts, rad or degrees) and sign of bending are inferred from the
/// numbers; a warning reports the inference.
[[nodiscard]] Recording recording_by_numbers(const std::filesystem::path& file,
                                             const NumberTable& table, TableLayout layout);

}  // namespace handway::device
