#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_description.h"

#include <filesystem>

namespace handway::geometric {

/// Replaces all `disable_collisions` of an SRDF file by those of the robot, adds the groups and end
/// effectors whose names it has not, and keeps the rest, comments included; makes the file if there
/// is none. The file is replaced whole.
/// @throws InputError if the old file is no SRDF or the new one can't be
/// written; the old file is then untouched.
HANDWAY_GEOMETRIC_EXPORT void update_srdf(const RobotDescription& robot,
                                          const std::filesystem::path& file);

/// Writes groups (by joints), end effectors, postures and allowed collisions of a robot as a
/// new SRDF file. The file is replaced whole.
/// @throws InputError if it can't be written.
HANDWAY_GEOMETRIC_EXPORT void write_srdf(const RobotDescription& robot,
                                         const std::filesystem::path& file);

}  // namespace handway::geometric
