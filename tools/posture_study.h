#pragma once

#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/device/glove/posture_source.h"
#include "handway/device/glove/recording.h"
#include "handway/device/glove/recording_quality.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/sampling/postures/basis_study.h"
#include "handway/sampling/postures/pmd_basis.h"
#include "handway/sampling/postures/principal_components.h"

#include <Eigen/Core>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace handway::tools {

/// Steps of processing a recording before it is mapped. 0: not done.
struct RecordingSteps {
  double from = 0.0;         ///< s
  std::optional<double> to;  ///< s
  bool drop_duplicates = false;
  double resample = 0.0;  ///< Hz
  double low_pass = 0.0;  ///< Hz
};

/// A recording that becomes postures of a hand.
struct MappedRecording {
  std::filesystem::path file;
  device::Recording recording;       ///< Angles, after all steps.
  device::RecordingQuality quality;  ///< Quality of the file as it was read.
  bool calibrated = false;           ///< True if it held counts.
  device::MappedPostures mapped;
};

/// Calibrates (counts only), filters in the order of the steps, and maps.
/// @param read from `file`.
[[nodiscard]] MappedRecording mapped_recording(const std::filesystem::path& file,
                                               const device::Recording& read,
                                               const device::GloveCalibration& calibration,
                                               const RecordingSteps& steps,
                                               const device::PostureSource& mapper);

/// Scaling of joints to [0, 1] before their components are found.
enum class Normalisation {
  kLimits,  ///< Postures clamped to the joint limits, by these limits.
  kRange,   ///< Postures of the mapping, by the least and most of each joint.
};

/// The postures of all recordings, one after the other, shape [samples, joints]. A fixed joint is
/// in the middle.
[[nodiscard]] Eigen::MatrixXd normalised_samples(const std::vector<MappedRecording>& recordings,
                                                 const device::PostureSource& mapper,
                                                 Normalisation normalisation);

/// Samples back in rad by the joint limits, shape [samples, joints].
[[nodiscard]] Eigen::MatrixXd joint_values(const Eigen::MatrixXd& samples,
                                           const device::PostureSource& mapper);

/// Components, and the number of samples left out.
struct Analysis {
  sampling::PrincipalComponents components;
  Eigen::Index samples = 0;
  Eigen::Index outliers = 0;
};

/// @param robust set outliers aside.
[[nodiscard]] Analysis analyse(const Eigen::MatrixXd& samples, const std::vector<int>& left_out,
                               bool robust);

/// Indices of joints by name. @throws InputError for an unknown one.
[[nodiscard]] std::vector<int> joint_indices(const std::vector<std::string>& names,
                                             const std::vector<std::string>& joints);

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

/// Studies the quality of a basis from these recordings, at the fingertips of the hand.
/// @throws InputError if the hand has no fingers, or a recording is too short.
[[nodiscard]] sampling::BasisStudy study_recordings(
    const std::vector<MappedRecording>& recordings,
    const std::shared_ptr<const geometric::RobotModel>& hand, const device::PostureSource& mapper,
    Normalisation normalisation, const sampling::BasisStudySettings& settings);

/// Writes the study with its inputs as a JSON file.
/// @throws InputError if it can't be written.
void write_study(const sampling::BasisStudy& study, const sampling::BasisStudySettings& settings,
                 const std::vector<MappedRecording>& recordings, const std::string& hand,
                 const device::PostureSource& mapper, const std::filesystem::path& file);

}  // namespace handway::tools
