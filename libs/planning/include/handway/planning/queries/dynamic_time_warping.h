#pragma once

#include "handway/planning/export.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace handway::planning {

/// Distance of two motions by dynamic time warping: the mean distance of the matched points, for
/// the monotonic matching of all points with the least sum. 0 for motions through the same points
/// at other speeds; symmetric (Sakoe and Chiba, "Dynamic programming algorithm optimization for
/// spoken word recognition", IEEE Transactions on Acoustics, Speech, and Signal Processing 26(1),
/// 1978, with the steps of their symmetric form P = 0, diagonal ones counted twice).
/// @param a, b a point a row, shape [points, joints]; each one point at least.
/// @returns in the unit of the joints, normalised joints if they are.
/// @throws std::invalid_argument for motions without points or of different joints.
[[nodiscard]] HANDWAY_PLANNING_EXPORT double warped_distance(const Eigen::MatrixXd& a,
                                                             const Eigen::MatrixXd& b);

/// Differences between several motions.
struct MotionSpread {
  std::size_t motions = 0;  ///< Number compared, ≥ 2.
  double median = 0.0;      ///< Median of the warped distances of all pairs.
  double largest = 0.0;
};

/// Compares each pair of motions, of more than 40 the first 40; nothing for fewer than two.
/// @throws as warped_distance().
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::optional<MotionSpread> motion_spread(
    const std::vector<Eigen::MatrixXd>& motions);

}  // namespace handway::planning
