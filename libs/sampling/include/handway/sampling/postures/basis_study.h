#pragma once

#include "handway/sampling/export.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/postures/posture_table.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// Quality of a basis made from recorded postures: the number of principal motion directions (PMDs)
/// needed, the length of a recording needed, and how well one basis serves several persons.

namespace handway::sampling {

/// Postures of one recording, in order of time.
struct RecordedHand {
  std::string name;
  Eigen::MatrixXd samples;  ///< Joints normalised to [0, 1], shape [rows, joints].
  double rate = 0.0;        ///< Rows a second, Hz, > 0.
};

/// Returns the fingertips at a posture of normalised joints, shape [joints]: one column each, m.
using FingertipsOf = std::function<Eigen::Matrix3Xd(const Eigen::VectorXd& posture)>;

/// Errors for which a report gives the number of directions needed, m.
inline constexpr std::array kReportedErrors{0.010, 0.005, 0.002};

/// Settings of a basis study.
struct BasisStudySettings {
  HandJointIndices free_joints;  ///< Joints with an axis of their own: see principal_components().
  int directions = 4;            ///< Number in the basis, for stability and persons; ≥ 1.
  int folds = 5;                 ///< Parts of each recording that are left out in turn, ≥ 2.
  int resamples = 1000;          ///< Number in the bootstrap, ≥ 1.
  double block = 1.0;  ///< Length of row blocks that stay together (rows depend on each other), s.
  double confidence = 0.95;  ///< Confidence of the intervals, 0 to 1.
  std::uint64_t seed = 1;
};

/// A mean, with its interval of the settings' confidence (percentiles of the bootstrap).
struct Interval {
  double mean = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// Error on postures that were not used to make the basis.
struct ReconstructionError {
  int directions = 0;     ///< Number beside the free joints.
  Interval fingertip;     ///< Distance of fingertips, mean over fingertips and postures, m.
  double most = 0.0;      ///< Bound of 95 % of the fingertips' distances, m.
  double variance = 0.0;  ///< Share of the variance of all postures in the directions.
};

/// Difference of bases from recordings of one length from the basis of the whole recording.
struct BasisStability {
  double seconds = 0.0;
  /// Largest principal angle between the spaces of the first 1, 2, … directions, rad; low and high
  /// bound the angles of single recordings, not their mean.
  std::vector<Interval> angles;
};

/// Error of a person's postures reconstructed with the settings' directions.
struct PersonFit {
  std::string name;
  Interval own;     ///< Error by a basis of the rest of the same recording, m.
  Interval others;  ///< Error by a basis of all other recordings, m.
  /// Largest principal angles between these persons' first 1, 2, … directions, rad.
  std::vector<double> angles;
};

/// Quality of a PMD basis: errors of reconstruction, stability and fit to other persons.
struct BasisStudy {
  std::vector<ReconstructionError> reconstruction;  ///< With 0, 1, … directions.
  std::vector<BasisStability> stability;            ///< By rising length.
  std::vector<PersonFit> persons;                   ///< Empty for one recording.
  Interval newcomer;  ///< Mean over persons of `others`: the expected error of a person who was not
                      ///< recorded, m; 0 for one recording.

  /// The fewest directions with which the mean error is below `error` (m) with the settings'
  /// confidence; -1: all are not enough.
  [[nodiscard]] HANDWAY_SAMPLING_EXPORT int enough_for(double error) const;
};

/// Studies the basis; the same recordings and settings give bitwise the same result.
///
/// Postures are reconstructed by a basis of other postures: each recording's folds are left out in
/// turn. Confidence intervals come from a bootstrap over blocks of rows (Künsch 1989), that of
/// `newcomer` from one over persons.
/// @throws geometric::InputError if there are fewer than two blocks in a recording.
/// @throws std::invalid_argument for settings out of range.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT BasisStudy
study_basis(const std::vector<RecordedHand>& recordings, const FingertipsOf& fingertips,
            const BasisStudySettings& settings = {});

/// Angles between the spaces of two bases of the same hand, free joints included, in rad,
/// ascending: see principal_angles(). Joints may be in another order.
/// @throws geometric::InputError if one basis has a joint that the other lacks, or no axis.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT Eigen::VectorXd angles_between(const PmdBasis& a,
                                                                     const PmdBasis& b);

/// Postures as a basis represents them: error outside of the space that it spans.
struct Reconstruction {
  Eigen::VectorXd rms;  ///< Error of each joint of the basis, normalised, shape [joints].
  double held = 0.0;    ///< Share of the variance about the postures' mean, at most 1.
};

/// @throws geometric::InputError if the table lacks a joint of the basis.
[[nodiscard]] HANDWAY_SAMPLING_EXPORT Reconstruction reconstruct(const PmdBasis& basis,
                                                                 const PostureTable& postures);

}  // namespace handway::sampling
