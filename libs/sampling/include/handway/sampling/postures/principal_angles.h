#pragma once

#include "handway/sampling/export.h"

#include <Eigen/Core>

namespace handway::sampling {

/// Angles between the spaces that the columns of two matrices span, in rad, rising, each in
/// [0, π/2]: 0 for a direction that both share (Björck and Golub 1973; small angles from sines,
/// large ones from cosines).
/// @param a, b orthonormal columns, shape [joints, …].
/// @returns as many as the narrower one has columns.
/// @throws std::invalid_argument if the numbers of rows differ or one has no columns.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT Eigen::VectorXd principal_angles(const Eigen::MatrixXd& a,
                                                                       const Eigen::MatrixXd& b);

}  // namespace handway::sampling
