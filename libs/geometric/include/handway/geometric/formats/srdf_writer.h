#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_description.h"

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

/// Writes groups (by joints), postures and allowed collisions of a robot as a
/// new SRDF file. The file is replaced whole.
/// @throws InputError if it can't be written.
HANDWAY_GEOMETRIC_EXPORT void write_srdf(const RobotDescription& robot,
                                         const std::filesystem::path& file);

}  // namespace handway::geometric
