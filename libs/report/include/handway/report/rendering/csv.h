#pragma once

#include "handway/report/document/table.h"
#include "handway/report/export.h"

#include <string>

namespace handway::report {

/// Returns a table for programs and spreadsheets: a header, then the rows; see Cell::field() and
/// csv_field().
[[nodiscard]] HANDWAY_REPORT_EXPORT std::string to_csv(const Table& table);

}  // namespace handway::report
