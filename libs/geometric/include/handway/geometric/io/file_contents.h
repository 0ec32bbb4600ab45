#pragma once

#include "handway/geometric/export.h"

#include <optional>
#include <string>
#include <string_view>

namespace handway::geometric {

/// Real kind of a file that replaces the expected one.
struct StandIn {
  std::string found;   ///< "a Git LFS pointer (…)", for InputProblem.
  std::string advice;  ///< Advice to the user.
};

/// Recognizes a file that replaces the expected one by its beginning: a pointer of Git LFS or
/// git-annex, a web page, an archive or compressed file. Nothing for anything else.
/// @param head the first bytes of the file.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<StandIn> stand_in(std::string_view head);

}  // namespace handway::geometric
