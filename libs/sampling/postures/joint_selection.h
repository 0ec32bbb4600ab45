#pragma once

#include <Eigen/Core>

#include <vector>

namespace handway::sampling {

/// Indices of the joints that aren't left out.
/// @throws std::invalid_argument if left_out names a joint that isn't there, one
/// twice, or all of them.
[[nodiscard]] std::vector<int> joints_taken(Eigen::Index joints, const std::vector<int>& left_out);

/// `direction` or its opposite: the one whose largest entry is positive.
[[nodiscard]] Eigen::VectorXd with_fixed_sign(const Eigen::VectorXd& direction);

/// Each over their sum; all 0 if that is 0.
[[nodiscard]] Eigen::VectorXd shares_of(const Eigen::VectorXd& variances);

}  // namespace handway::sampling
