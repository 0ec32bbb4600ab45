#pragma once

#include "collision/volumes/distance_field.h"
#include "collision/volumes/sphere_tree.h"
#include "handway/geometric/math/pose.h"

#include <array>
#include <cstdint>

namespace handway::geometric {

/// What a moved point may be off by in single precision, for each metre of its
/// coordinates: some 30 roundings of 6e-8 each.
inline constexpr float kMoveRounding = 2e-6F;

/// A rigid transform in single precision, with what its roundings can amount to.
struct FloatPose {
  FloatPose() = default;
  /// @param reach (m) how far from A's origin points are that it will move.
  FloatPose(const Pose& X_BA, float reach);

  std::array<float, 9> R{};  ///< Row by row.
  std::array<float, 3> p{};
  float rounding = 0.0F;  ///< m: a moved point, or a bound there, is off by less.
};

/// Bounds of a node's spheres.
struct SphereBounds {
  std::uint32_t near = 0;  ///< Bit k: sphere k may be nearer than asked for.
  alignas(64) std::array<float, SphereTree::kWidth> bound;  ///< m, of those; negative: overlap.
};

/// Which spheres of a node may be nearer than `tolerance` (m) to the field's
/// surface, and lower bounds of their distances.
/// @param X_BA pose of the spheres' frame in the field's.
void sphere_bounds(const SphereTree::Node& node, const DistanceField& field, const FloatPose& X_BA,
                   float tolerance, SphereBounds& bounds);

}  // namespace handway::geometric
