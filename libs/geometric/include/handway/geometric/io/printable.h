#pragma once

#include "handway/geometric/export.h"

#include <string>
#include <string_view>

namespace handway::geometric {

/// Text that may come from files, fit for a terminal and for reports: control characters but tabs
/// and ends of lines, and marks that turn the direction of writing, appear as they are written in
/// JSON ("\u001b"), bytes that are no UTF-8 as "\ufffd". Other text stays the same.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string printable(std::string_view text);

}  // namespace handway::geometric
