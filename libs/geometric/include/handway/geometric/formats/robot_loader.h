#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_model.h"

#include <filesystem>
#include <memory>

namespace handway::geometric {

/// Reads a robot file (`.urdf`, with the `.srdf` beside it) and makes the model.
/// If no SRDF disables any collision, the links that a joint connects and those that overlap
/// (sample_overlapping_links()) are allowed to touch and, if it names no group either, the groups
/// are those of propose_groups(): with warnings in the description.
/// @throws InputError if the file can't be read or makes no robot.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::shared_ptr<const RobotModel> load_robot(
    const std::filesystem::path& file);

}  // namespace handway::geometric
