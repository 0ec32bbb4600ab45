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

}  // namespace handway::sampling
