#pragma once

#include "handway/sampling/export.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace handway::sampling {

/// Principal components of a set of postures (paper, section 4.2).
struct PrincipalComponents {
  Eigen::VectorXd mean;        ///< Mean of every joint, shape [joints].
  Eigen::MatrixXd directions;  ///< One unit column per component, shape [joints, components].
  Eigen::VectorXd variances;   ///< σ_i² along each, falling, shape [components].
  Eigen::VectorXd shares;      ///< variances over their sum; all 0 if nothing varies.
};

/// Principal component analysis by singular value decomposition of the
/// mean-centred samples. Variances are Σ x² / (samples - 1). A direction's
/// largest entry is positive, so that the same data give the same signs.
/// @param samples one posture a row, joints normalised to [0, 1], shape [samples, joints].
/// @param left_out joints to ignore: their entries are 0 in all directions and their
/// variance counts in no share.
/// @returns min(samples, joints used) components.
/// @throws geometric::InputError if there are fewer than two samples or one is not finite.
/// @throws std::invalid_argument if left_out names an unknown joint, one twice, or all of
/// them.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT PrincipalComponents
principal_components(const Eigen::MatrixXd& samples, const HandJointIndices& left_out = {});

/// Axes of a basis, and lengths of the sides of its box.
struct PmdBasisOptions {
  HandJointIndices free_joints;       ///< Axes of their own, over the joint's whole range.
  int directions = 4;                 ///< Most principal directions to take, ≥ 0.
  double sigmas_per_half_side = 1.5;  ///< λ_i = this · σ_i. > 0.
};

/// The PMD basis of the first components: the free joints, then directions PMD1, PMD2, … Directions
/// without variation (σ < 1e-9) are left out.
/// @param joints names, shape [joints].
/// @pre `components` were computed with options.free_joints left out.
/// @throws std::invalid_argument if the number of joints differs or an option is out of range.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT PmdBasis make_pmd_basis(std::string hand, std::string source,
                                                              std::vector<std::string> joints,
                                                              const PrincipalComponents& components,
                                                              const PmdBasisOptions& options = {});

/// Principal components of postures that arrive one by one, such as from a glove in use. Mean and
/// scatter are updated with each posture (Welford 1962), so that after n postures the components
/// are those of all n, up to rounding. Memory and time per posture don't grow. For one thread at a
/// time.
class HANDWAY_SAMPLING_EXPORT IncrementalComponents {
 public:
  /// @param joints length of every posture, ≥ 1.
  /// @throws std::invalid_argument for fewer.
  explicit IncrementalComponents(int joints);

  /// @param posture joints normalised to [0, 1], shape [joints].
  /// @throws std::invalid_argument for another length or a value that isn't finite.
  void add(const Eigen::VectorXd& posture);
  /// Adds all postures of `other` (Chan, Golub and LeVeque 1979).
  /// @throws std::invalid_argument if it has another number of joints.
  void add(const IncrementalComponents& other);

  [[nodiscard]] Eigen::Index count() const { return count_; }

  /// Returns the result of principal_components() for the same postures.
  /// @throws as that function.
  [[nodiscard]] PrincipalComponents components(const HandJointIndices& left_out = {}) const;

 private:
  Eigen::Index count_ = 0;
  Eigen::VectorXd mean_;
  Eigen::MatrixXd scatter_;  ///< Σ (x - mean)(x - mean)'.
};

/// Components of the samples without outliers.
struct RobustComponents {
  PrincipalComponents components;  ///< Components of the samples that were used.
  std::vector<bool> kept;          ///< False: an outlier, shape [samples].
  Eigen::Index outliers = 0;
};

/// Principal components that are robust against few outliers (a slipped sensor, a lost record):
/// the reweighted minimum covariance determinant (Rousseeuw and Van Driessen 1999) from one fixed
/// start. It begins with the half of the samples nearest to the medians of the joints, in units of
/// the median deviations. Then it takes, until they stay the same, the three quarters nearest by
/// Mahalanobis distance to the mean and covariance of those taken before. At last it keeps samples
/// within the 97.5 % quantile of χ² of that distance, scaled so that its median is that of χ², and
/// analyses them as principal_components() does. Directions without variation count in no
/// distance.
/// @param samples, left_out and errors as for principal_components().
[[nodiscard]] HANDWAY_SAMPLING_EXPORT RobustComponents
robust_principal_components(const Eigen::MatrixXd& samples, const HandJointIndices& left_out = {});

}  // namespace handway::sampling
