#pragma once

#include "handway/geometric/export.h"

#include <filesystem>
#include <string_view>

namespace handway::geometric {

/// Writes `content` to `file` atomically: the file holds either its former or all of
/// the new content. It writes a temporary file beside it, flushes it to disk, then
/// renames it. Permissions stay; a link stays a link. Other than regular files
/// (`/dev/stdout`) are written to directly. Temporary files that killed programs of
/// this machine have left in the folder are removed when the program first writes
/// there.
/// @throws OutputError if it can't be written (the old file is untouched).
HANDWAY_GEOMETRIC_EXPORT void replace_file(const std::filesystem::path& file,
                                           std::string_view content);

}  // namespace handway::geometric
