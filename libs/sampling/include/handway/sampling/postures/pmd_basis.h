#pragma once

#include "handway/sampling/export.h"

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

namespace handway::sampling {

/// Joints of a hand, by their indices in PmdBasis::joints or the columns of a table of postures.
using HandJointIndices = std::vector<int>;

/// A hand joint that is sampled independently, beside the principal directions (the paper's thumb
/// base, section 4.2).
struct FreeJoint {
  int joint = 0;           ///< Index into PmdBasis::joints.
  double centre = 0.5;     ///< Normalised.
  double half_side = 0.5;  ///< λ of this axis, normalised.
};

/// One principal motion direction.
struct PrincipalDirection {
  std::string name;
  Eigen::VectorXd vector;  ///< ê_i in normalised joints, shape [joints], unit length.
  double half_side = 0.0;  ///< λ_i, normalised.
  double variance = 0.0;   ///< σ_i², normalised; 0 if not known.
};

/// The reduced hand space SC^h: free joints plus principal motion directions
/// around the mean posture (paper, section 4.2 and Eq. 1), and its box B^h.
///
/// Postures are in joint space normalised to [0, 1] per joint.
struct PmdBasis {
  std::string hand;                            ///< Robot that the joints belong to.
  std::string source;                          ///< Source of the numbers.
  std::vector<std::string> joints;             ///< Independent hand joints, in vector order.
  Eigen::VectorXd mean;                        ///< b, shape [joints].
  std::vector<FreeJoint> free_joints;          ///< First axes of SC^h.
  std::vector<PrincipalDirection> directions;  ///< Following axes, by falling variance.
  /// The recorded postures of the basis (see read_postures()); empty: not stored.
  std::filesystem::path postures = {};

  /// Axes of the whole SC^h.
  [[nodiscard]] int dimension() const {
    return static_cast<int>(free_joints.size() + directions.size());
  }
};

/// MAP of Algorithm 2: takes u in [0,1]^k, k ≤ dimension(), scales axis i to
/// [-λ_i, λ_i], applies c = E' e + b (Eq. 1; axes beyond k stay at 0) and clamps
/// every joint to [0, 1].
/// @param u shape [k].
/// @returns normalised joints, shape [joints].
/// @throws std::invalid_argument if u has more entries than the basis has axes.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT Eigen::VectorXd map_to_posture(const PmdBasis& basis,
                                                                     const Eigen::VectorXd& u);

/// E' of Eq. 1: the axes of SC^h, free joints first. @returns shape [joints, dimension].
[[nodiscard]] HANDWAY_SAMPLING_EXPORT Eigen::MatrixXd axes_of(const PmdBasis& basis);

/// λ of each axis. @returns shape [dimension].
[[nodiscard]] HANDWAY_SAMPLING_EXPORT Eigen::VectorXd half_sides_of(const PmdBasis& basis);

/// b, free joints at their own centres. @returns shape [joints].
[[nodiscard]] HANDWAY_SAMPLING_EXPORT Eigen::VectorXd centre_of(const PmdBasis& basis);

/// Coordinates e of the posture of SC^h closest to `posture` (least squares),
/// not limited to the box. @param posture shape [joints]. @returns shape [dimension].
[[nodiscard]] HANDWAY_SAMPLING_EXPORT Eigen::VectorXd project(const PmdBasis& basis,
                                                              const Eigen::VectorXd& posture);

/// Distance of `posture` from SC^h, in normalised joints: its deviation from the recorded postures
/// of the human hand.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT double distance_to_subspace(const PmdBasis& basis,
                                                                  const Eigen::VectorXd& posture);

/// The basis whose axes are all the joints over their whole range: the paper's
/// "full" hand space (section 6.2).
[[nodiscard]] HANDWAY_SAMPLING_EXPORT PmdBasis full_joint_basis(std::string hand,
                                                                std::vector<std::string> joints);

/// The affine space of SC^h, prepared for many postures; distance_to_subspace() is for one.
/// Postures are normalised joints, shape [joints].
class HANDWAY_SAMPLING_EXPORT PostureSubspace {
 public:
  explicit PostureSubspace(const PmdBasis& basis);

  /// Vector from the closest posture of SC^h, regardless of limits, to `posture`; shape [joints].
  [[nodiscard]] Eigen::VectorXd outside(const Eigen::VectorXd& posture) const;

  /// Distance of `posture` from the recorded postures of the human hand.
  [[nodiscard]] double distance(const Eigen::VectorXd& posture) const;

  /// The posture of SC^h closest to `posture`, joints clamped to [0, 1].
  [[nodiscard]] Eigen::VectorXd closest(const Eigen::VectorXd& posture) const;

 private:
  Eigen::VectorXd centre_;
  Eigen::MatrixXd across_;  ///< Projects a difference of postures onto its part outside of SC^h.
};

/// Principal angles between the column spaces of two matrices, in rad, ascending, each in [0, π/2]:
/// 0 for a direction that both share (Björck and Golub 1973; small angles from sines, large ones
/// from cosines).
/// @param a, b orthonormal columns, shape [joints, …].
/// @returns as many angles as the narrower one has columns.
/// @throws std::invalid_argument if the numbers of rows differ or one has no columns.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT Eigen::VectorXd principal_angles(const Eigen::MatrixXd& a,
                                                                       const Eigen::MatrixXd& b);

// PMD bases as YAML files:
//
//     hand: sah_right            # robot that the joints belong to: a file from this one's folder
//     source: "where the numbers come from"
//     units: normalised          # joints scaled to [0, 1]
//     postures: sah_right.csv    # optional: the recorded postures, from this file's folder
//     joints: [thumb_base, thumb_abduction, …]
//     mean: [0.3055, …]          # one number per joint
//     free_joints:               # optional
//       - {joint: thumb_base, half_side: 0.5, centre: 0.3055}
//     directions:                # optional; variance: optional
//       - {name: PMD1, half_side: 0.8275, variance: 0.1, vector: [0, -0.0683, …]}

/// @throws geometric::InputError with file, line and key for anything that is not YAML,
/// missing, unknown, of the wrong length, not finite, or out of range: half sides must be
/// positive, variances not negative, vectors of unit length within 1 %, joint names
/// distinct.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT PmdBasis read_pmd_basis(const std::filesystem::path& file);

/// Replaces the file whole. Postures are named from the file's folder. Numbers have as few digits
/// as give the same bits when read again; a direction whose vector is not of unit length is
/// normalised, with the same span. A variance of 0 (unknown) is left out.
/// @throws geometric::InputError if the file can't be written.
HANDWAY_SAMPLING_EXPORT void write_pmd_basis(const PmdBasis& basis,
                                             const std::filesystem::path& file);

}  // namespace handway::sampling
