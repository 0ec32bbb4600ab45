#pragma once

#include "handway/sampling/export.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/postures/recorded_motions.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace handway::sampling {

/// Functional principal components of recorded hand motions: the functions of time of which each
/// recorded motion is a weighted sum, about their mean.
///
/// The time-normalised trajectories of all joints are stacked to one vector for each motion, and
/// the principal components of these vectors are computed (Ramsay and Silverman, "Functional Data
/// Analysis", 2nd ed. 2005, chapter 8; for human hand and arm motions Averta et al., "Exploiting
/// upper-limb functional principal components for human-like motion generation of anthropomorphic
/// robots", Journal of NeuroEngineering and Rehabilitation 17, 2020). A motion is reconstructed
/// from the components that together have 95 % of the variance; its error is what they can't
/// represent. Recorded motions are reconstructed from the components of other motions: ten blocks
/// of consecutive motions are left out in turn.
class HANDWAY_SAMPLING_EXPORT MotionComponents {
 public:
  /// Fewest motions from which components are computed.
  static constexpr std::size_t kFewestMotions = 10;

  /// @param motions all of the same joints, kFewestMotions or more.
  /// @param left_out joints that don't count; nor do joints that no motion moves.
  /// @throws std::invalid_argument for fewer motions, other shapes, an unknown joint, or if no
  /// joint is left.
  explicit MotionComponents(const std::vector<HandMotion>& motions,
                            const HandJointIndices& left_out = {});

  /// Number of motions that they were computed from.
  [[nodiscard]] std::size_t motions() const { return motions_; }
  /// Number of components that have 95 % of the variance.
  [[nodiscard]] Eigen::Index count() const { return axes_.cols(); }
  /// Joints that count, ascending.
  [[nodiscard]] const HandJointIndices& joints() const { return joints_; }

  /// RMS error over time of each joint that counts, in normalised joints, shape [joints()].
  /// @param motion normalised joints, shape [kMotionPoints, joints of the motions].
  /// @throws std::invalid_argument for another shape.
  [[nodiscard]] Eigen::VectorXd errors(const Eigen::MatrixXd& motion) const;

  /// Errors of the recorded motions, each reconstructed from other motions, shape [motions(),
  /// joints()].
  [[nodiscard]] const Eigen::MatrixXd& held_out_errors() const { return held_out_; }

 private:
  std::size_t motions_ = 0;
  Eigen::Index columns_ = 0;  ///< Joints of a motion.
  HandJointIndices joints_;
  Eigen::VectorXd mean_;  ///< Shape [kMotionPoints · joints()], joint by joint.
  Eigen::MatrixXd axes_;  ///< Unit columns, shape [kMotionPoints · joints(), count()].
  Eigen::MatrixXd held_out_;
};

}  // namespace handway::sampling
