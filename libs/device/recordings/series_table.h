#pragma once

#include "recordings/array_file.h"
#include "recordings/number_table.h"
#include "recordings/table_layout.h"

namespace handway::device {

/// The values of a series as a table, with gaps for values that are not finite. Its times are in a
/// further column behind the others, named "time" if columns have names.
[[nodiscard]] NumberTable table_of(const Series& series);

/// The use of that further column for the times of rows; empty without times.
[[nodiscard]] std::vector<ColumnUse> time_columns_of(const Series& series);

}  // namespace handway::device
