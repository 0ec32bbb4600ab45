#pragma once

#include "handway/geometric/export.h"
#include "handway/geometric/robot/robot_description.h"
#include "handway/geometric/robot/robot_model.h"

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::geometric {

/// The pairs of links with collision geometry that a joint connects, also through links without
/// geometry.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT AllowedCollisions adjacent_links(const RobotModel& model);

/// Number of collisions of two links that are not adjacent.
struct SampledPair {
  std::string a;
  std::string b;
  int collisions = 0;       ///< Number of samples in collision.
  bool at_neutral = false;  ///< In RobotModel::neutral().
  bool at_middle = false;   ///< With every joint in the middle of its range.
  /// True if one joint moves both, and is at the end of its range at neutral.
  bool jaws = false;
  bool by_user = false;  ///< The robot allows it by AllowedReason::kUser.

  /// True if in collision at the neutral posture and in at least half of the samples: the shapes
  /// overlap by construction, as those of a knuckle and its palm may.
  [[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool overlaps(int samples) const;
  /// Jaws of a gripper that meet at the end of their joint's range, and rarely before: in at most 1
  /// % of the samples. They are designed to touch.
  [[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool closes(int samples) const;
  /// True for other pairs, unless always in collision or by_user: their collisions count.
  [[nodiscard]] HANDWAY_GEOMETRIC_EXPORT bool is_checked(int samples) const;
};

/// Self-collisions found in random configurations.
struct SelfCollisionSamples {
  int samples = 0;
  /// Samples with a collision of checked pairs.
  int colliding = 0;
  std::vector<SampledPair> pairs;
};

/// Counts collisions of all pairs of links that move against each other and are not adjacent, in
/// configurations sampled uniformly between the limits. Only allowed collisions by the user are
/// taken into account. Same model, samples and seed give the same counts. One thread.
/// @param stop ends it after the present sample: `samples` is the number of those done.
/// @param progress is called with the share done, from 0 to 1; may be empty.
/// @throws std::invalid_argument if `samples` < 1.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT SelfCollisionSamples sample_self_collisions(
    const RobotModel& model, int samples, std::uint64_t seed, const std::stop_token& stop = {},
    const std::function<void(double)>& progress = {});

/// The resulting allowed-collision matrix: pairs that are adjacent, that were in collision in every
/// sample (Always) or in none (Never), and that overlap (Default).
///
/// "Never" is a statement about the samples only: more samples make it safer.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT AllowedCollisions
allowed_collisions(const RobotModel& model, const SelfCollisionSamples& sampled);

/// Samples without looking for pairs that never collide, in a fraction of the time. The result
/// makes a robot usable and excludes no pair that may collide unless it always does.
/// @throws std::invalid_argument if `samples` < 1.
[[nodiscard]] HANDWAY_GEOMETRIC_EXPORT AllowedCollisions
sample_overlapping_links(const RobotModel& model, int samples, std::uint64_t seed);

}  // namespace handway::geometric
