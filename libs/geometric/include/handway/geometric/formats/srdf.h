#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_description.h"

#include <filesystem>
#include <string>
#include <vector>

namespace handway::geometric {

/// Adds the contents of an SRDF file (http://wiki.ros.org/srdf) to its robot: `group` (by
/// joints, links, chains and subgroups), `group_state` and `disable_collisions`. Handway's own
/// element is `coupling` (see couple_joint()): its joint, an offset, and for each joint that it
/// `follows` a multiplier. Reasons other than Adjacent, Always and Never are read as User. Lines
/// about unknown links, joints and groups are skipped, as are unknown elements: one warning
/// each.
/// @throws InputError naming the line if the file can't be read, an element is misspelt or a number
/// is invalid; `robot` is then unchanged.
HANDWAY_GEOMETRIC_EXPORT void read_srdf(const std::filesystem::path& file, RobotDescription& robot);

/// Returns the names of its groups, in the file's order, without reading the groups.
/// @throws InputError if the file can't be read or is no SRDF.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::vector<std::string> srdf_group_names(
    const std::filesystem::path& file);

/// Replaces all `disable_collisions` of an SRDF file by those of the robot, adds the groups and end
/// effectors whose names it lacks, and keeps the rest, comments included; creates a missing file.
/// The file is replaced whole.
/// @param decided groups that replace those of the file; if the robot lacks one, it is removed with
/// its postures, and so are all end effectors that the robot lacks.
/// @throws InputError if the old file is not SRDF or the new one can't be written; the old file is
/// then untouched.
HANDWAY_GEOMETRIC_EXPORT void update_srdf(const RobotDescription& robot,
                                          const std::filesystem::path& file,
                                          const std::vector<std::string>& decided = {});

/// Writes groups (by joints), end effectors, postures and allowed collisions of a robot as a
/// new SRDF file. The file is replaced whole.
/// @throws InputError if it can't be written.
HANDWAY_GEOMETRIC_EXPORT void write_srdf(const RobotDescription& robot,
                                         const std::filesystem::path& file);

}  // namespace handway::geometric
