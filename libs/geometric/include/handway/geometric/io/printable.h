#pragma once

#include "handway/geometric/export.h"

#include <string>
#include <string_view>

namespace handway::geometric {

/// Makes text from files fit for a terminal and for reports. Control characters but tabs and ends
/// of lines, and marks that change the direction of writing, are written as in JSON ("\u001b"),
/// invalid UTF-8 as "\ufffd". Other text stays the same.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::string printable(std::string_view text);

}  // namespace handway::geometric
