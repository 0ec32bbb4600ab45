#pragma once

#include "handway/sampling/postures/pmd_basis.h"
#include "mapped_recording.h"

#include <Eigen/Core>

#include <filesystem>
#include <string>

namespace handway::tools {

/// A recording of a glove mapped to the SAH hand by the paper's Table 1, and its principal motion
/// directions: of all joints but the thumb base, which has an axis of its own (section 4.2).
struct PostureStudy {
  std::filesystem::path recording;
  Normalisation normalisation = Normalisation::kLimits;  ///< Scaling of basis and postures.
  sampling::PmdBasis basis;
  Eigen::MatrixXd postures;       ///< rad, shape [samples, joints of the basis].
  Eigen::MatrixXd samples;        ///< The postures in normalised joints, same shape.
  Eigen::VectorXd shares;         ///< Shares of the variance, shape [directions].
  Eigen::VectorXd limits_shares;  ///< Shares with joints by their limits, …
  Eigen::VectorXd range_shares;   ///< … and by the range of their motion.

  /// Correlation of two joints, -1 to 1. @pre the basis has them.
  [[nodiscard]] double correlation(const std::string& first, const std::string& second) const;
};

/// Counts are interpreted as those of a typical right hand.
/// @throws InputError if the recording can't be read or has no postures.
[[nodiscard]] PostureStudy study_postures(const std::filesystem::path& recording,
                                          Normalisation normalisation);

}  // namespace handway::tools
