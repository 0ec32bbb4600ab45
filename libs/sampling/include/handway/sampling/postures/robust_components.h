#pragma once

#include "handway/sampling/export.h"
#include "handway/sampling/postures/principal_components.h"

#include <Eigen/Core>

#include <vector>

namespace handway::sampling {

/// Components of the samples that belong together.
struct RobustComponents {
  PrincipalComponents components;  ///< Of the samples that were kept.
  std::vector<bool> kept;          ///< False: an outlier, shape [samples].
  Eigen::Index outliers = 0;
};

/// Principal components that few wild samples (a slipped sensor, a lost record) don't turn: the
/// reweighted minimum covariance determinant (Rousseeuw and Van Driessen 1999) from one fixed
/// start. Begins with the half of the samples nearest to the medians of the joints, in units of
/// the median deviations. Then takes, until they stay the same, the three quarters nearest by
/// Mahalanobis distance to the mean and covariance of those taken before. At last keeps
/// what lies within the 97.5 % quantile of χ² of that distance, scaled so that its median is
/// that of χ², and analyses it as principal_components() does. Directions along which nothing
/// varies count in no distance.
/// @param samples, left_out and errors as for principal_components().
[[nodiscard]] HANDWAY_SAMPLING_EXPORT RobustComponents
robust_principal_components(const Eigen::MatrixXd& samples, const std::vector<int>& left_out = {});

}  // namespace handway::sampling
