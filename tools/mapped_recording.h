#pragma once

#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/posture_source.h"
#include "handway/device/glove/recording.h"
#include "handway/device/glove/recording_quality.h"
#include "handway/sampling/postures/principal_components.h"

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// Recordings that are mapped to a hand, and the components of their postures.

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

}  // namespace handway::tools
