#pragma once

#include "handway/device/glove/raw_columns.h"
#include "recordings/number_table.h"
#include "recordings/table_layout.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace handway::device {

/// Returns the columns of numbers of a table as they are in the file.
/// @param layout gives the units of used columns: "counts", "rad" or "deg".
[[nodiscard]] RawColumns raw_columns_of_table(const NumberTable& table, const TableLayout& layout);

/// Returns the rows of a table's raw columns for its recording: those that came with the table, or
/// all of its columns; nothing if the recording has them all, unchanged.
[[nodiscard]] std::optional<RawColumns> raw_columns_of_rows(const NumberTable& table,
                                                            const TableLayout& layout,
                                                            const std::vector<Eigen::Index>& rows);

}  // namespace handway::device
