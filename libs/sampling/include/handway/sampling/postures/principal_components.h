#pragma once

#include "handway/sampling/export.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace handway::sampling {

/// Principal components of a set of postures (paper, section 4.2).
struct PrincipalComponents {
  Eigen::VectorXd mean;        ///< Of every joint, shape [joints].
  Eigen::MatrixXd directions;  ///< One unit column per component, shape [joints, components].
  Eigen::VectorXd variances;   ///< σ_i² along each, falling, shape [components].
  Eigen::VectorXd shares;      ///< variances over their sum; all 0 if nothing varies.
};

/// Principal component analysis by singular value decomposition of the
/// mean-centred samples. Variances are Σ x² / (samples - 1). A direction's
/// largest entry is positive, so that the same data give the same signs.
/// @param samples one posture a row, joints normalised to [0, 1], shape [samples, joints].
/// @param left_out indices of joints that take no part: their entries are 0 in
/// all directions and their variance counts in no share.
/// @returns min(samples, joints that take part) components.
/// @throws geometric::InputError if there are fewer than two samples or one is not finite.
/// @throws std::invalid_argument if left_out names a joint that isn't there, one
/// twice, or all of them.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT PrincipalComponents
principal_components(const Eigen::MatrixXd& samples, const std::vector<int>& left_out = {});

/// Which axes a basis has, and how long the sides of its box are.
struct PmdBasisOptions {
  std::vector<int> free_joints;       ///< Axes of their own, over the joint's whole range.
  int directions = 4;                 ///< Most principal directions to take, ≥ 0.
  double sigmas_per_half_side = 1.5;  ///< λ_i = this · σ_i. > 0.
};

/// The PMD basis of the first components: the free joints, then directions PMD1,
/// PMD2, … Directions along which nothing varies (σ < 1e-9) are left out.
/// @param joints names, shape [joints].
/// @pre `components` were computed with options.free_joints left out.
/// @throws std::invalid_argument if the number of joints differs or an option is out of range.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT PmdBasis make_pmd_basis(std::string hand, std::string source,
                                                              std::vector<std::string> joints,
                                                              const PrincipalComponents& components,
                                                              const PmdBasisOptions& options = {});

}  // namespace handway::sampling
