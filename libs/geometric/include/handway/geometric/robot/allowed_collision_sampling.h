#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/allowed_collisions.h"
#include "handway/geometric/robot/robot_model.h"

#include <cstdint>

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

}  // namespace handway::geometric
