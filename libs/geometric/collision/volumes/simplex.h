#pragma once

#include <Eigen/Core>

#include <array>

namespace handway::geometric {

/// Corners of the triangle that is nearest so far, in a search for the nearest point of a convex
/// set.
using Simplex = std::array<Eigen::Vector3d, 3>;

/// Returns whether `p` is in the tetrahedron of the triangle `base` and the corner `top`; false if
/// that is flat.
[[nodiscard]] bool tetrahedron_contains(const Simplex& base, const Eigen::Vector3d& top,
                                        const Eigen::Vector3d& p);

}  // namespace handway::geometric
