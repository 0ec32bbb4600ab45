#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/allowed_collisions.h"

#include <filesystem>
#include <string>

namespace handway::geometric {

/// Replaces all `disable_collisions` of an SRDF file by `allowed` and keeps the
/// rest, comments included; makes the file if there is none. The file is
/// replaced whole.
/// @param robot the robot's name, for a new file.
/// @throws InputError if the old file is no SRDF or the new one can't be
/// written; the old file is then untouched.
HANDWAY_GEOMETRIC_EXPORT void write_disabled_collisions(const std::filesystem::path& file,
                                                        const std::string& robot,
                                                        const AllowedCollisions& allowed);

}  // namespace handway::geometric
