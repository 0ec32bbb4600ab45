#pragma once

#include "handway/sampling/export.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/postures/posture_table.h"

#include <Eigen/Core>

namespace handway::sampling {

/// Angles between what two bases of the same hand span, free joints included, in rad, rising: see
/// principal_angles(). Joints may be in another order.
/// @throws geometric::InputError if one basis has a joint that the other lacks, or no axis.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT Eigen::VectorXd angles_between(const PmdBasis& a,
                                                                     const PmdBasis& b);

/// How well a basis holds postures: what is left of them outside of what it spans.
struct Reconstruction {
  Eigen::VectorXd rms;  ///< Of each joint of the basis, normalised, shape [joints].
  double held = 0.0;    ///< Share of the variance about the postures' mean, at most 1.
};

/// @throws geometric::InputError if the table lacks a joint of the basis.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT Reconstruction reconstruct(const PmdBasis& basis,
                                                                 const PostureTable& postures);

}  // namespace handway::sampling
