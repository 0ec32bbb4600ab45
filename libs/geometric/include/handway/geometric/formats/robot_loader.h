#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_description.h"
#include "handway/geometric/robot/robot_model.h"

#include <cstdint>
#include <filesystem>
#include <memory>

namespace handway::geometric {

/// The pairs of links with collision geometry that a joint connects, also where
/// links without geometry stand between them.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT AllowedCollisions adjacent_links(const RobotModel& model);

/// Computes the allowed-collision matrix of a robot from its geometry: pairs
/// that are adjacent, and pairs that were in collision in every (Always) or in
/// no (Never) one of `samples` configurations drawn uniformly between the
/// limits. The robot's present matrix plays no part.
///
/// "Never" is a claim about the samples only: more samples make it safer.
/// Same model, samples and seed give the same matrix. One thread.
/// @throws std::invalid_argument if `samples` < 1.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT AllowedCollisions
sample_allowed_collisions(const RobotModel& model, int samples, std::uint64_t seed);

/// Reads a robot file (`.urdf`, with the `.srdf` beside it) and makes the model.
/// If no SRDF disables any collision, the links that a joint connects are
/// allowed to touch, with a warning in the description.
/// @throws InputError if the file can't be read or makes no robot.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT std::shared_ptr<const RobotModel> load_robot(
    const std::filesystem::path& file);

}  // namespace handway::geometric
