#pragma once

#include "handway/geometric/export.h"

#include <filesystem>
#include <string_view>

namespace handway::geometric {

/// Writes `content` to `file` so that, whatever happens, the file holds either
/// what it held before or all of the new content: a temporary file beside it,
/// flushed to disk, then renamed. Permissions stay; a link stays a link. What is
/// no regular file (`/dev/stdout`) is written to directly. Temporary files that
/// killed programs of this machine have left in the folder are removed when the
/// program first writes there.
/// @throws OutputError if it can't be written (the old file is untouched).
HANDWAY_GEOMETRIC_EXPORT void replace_file(const std::filesystem::path& file,
                                           std::string_view content);

}  // namespace handway::geometric
