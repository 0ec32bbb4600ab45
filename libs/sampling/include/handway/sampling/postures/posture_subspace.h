#pragma once

#include "handway/sampling/export.h"
#include "handway/sampling/postures/pmd_basis.h"

#include <Eigen/Core>

namespace handway::sampling {

/// The affine space that SC^h spans, ready to ask for many postures: what
/// distance_to_subspace() answers for one. Postures are normalised joints, shape [joints].
class HANDWAY_SAMPLING_EXPORT PostureSubspace {
 public:
  explicit PostureSubspace(const PmdBasis& basis);

  /// From the closest posture of SC^h, limits apart, to `posture`; shape [joints].
  [[nodiscard]] Eigen::VectorXd outside(const Eigen::VectorXd& posture) const;

  /// How far `posture` is from the postures that the human hand was seen to take.
  [[nodiscard]] double distance(const Eigen::VectorXd& posture) const;

  /// The posture of SC^h closest to `posture`, joints clamped to [0, 1].
  [[nodiscard]] Eigen::VectorXd closest(const Eigen::VectorXd& posture) const;

 private:
  Eigen::VectorXd centre_;
  Eigen::MatrixXd across_;  ///< Takes a difference of postures to its part outside of SC^h.
};

/// Angles between the spaces that the columns of two matrices span, in rad, rising, each in
/// [0, π/2]: 0 for a direction that both share (Björck and Golub 1973; small angles from sines,
/// large ones from cosines).
/// @param a, b orthonormal columns, shape [joints, …].
/// @returns as many as the narrower one has columns.
/// @throws std::invalid_argument if the numbers of rows differ or one has no columns.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT Eigen::VectorXd principal_angles(const Eigen::MatrixXd& a,
                                                                       const Eigen::MatrixXd& b);

}  // namespace handway::sampling
