#pragma once

#include "handway/geometric/export.h"

#include <optional>
#include <string>
#include <string_view>

namespace handway::geometric {

/// What a file really is that stands in the place of another.
struct StandIn {
  std::string found;   ///< "a Git LFS pointer (…)", for InputProblem.
  std::string advice;  ///< What to do about it.
};

/// What stands in the place of a file that begins like this: a pointer of Git LFS or git-annex, a
/// web page, an archive or compressed file. Nothing for anything else.
/// @param head the first bytes of the file.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::optional<StandIn> stand_in(std::string_view head);

}  // namespace handway::geometric
