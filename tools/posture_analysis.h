#pragma once

#include "handway/device/glove/hand_mapper.h"
#include "handway/sampling/postures/principal_components.h"
#include "mapped_recording.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace handway::tools {

/// How joints are scaled to [0, 1] before their components are found.
enum class Normalisation {
  kLimits,  ///< Postures clamped to the joint limits, by these limits.
  kRange,   ///< Postures as the mapping gave them, by the least and most of each joint.
};

/// The postures of all recordings, one after the other, shape [samples, joints]. A joint that
/// doesn't move is in the middle.
[[nodiscard]] Eigen::MatrixXd normalised_samples(const std::vector<MappedRecording>& recordings,
                                                 const device::HandMapper& mapper,
                                                 Normalisation normalisation);

/// Samples back in rad by the joint limits, shape [samples, joints].
[[nodiscard]] Eigen::MatrixXd joint_values(const Eigen::MatrixXd& samples,
                                           const device::HandMapper& mapper);

/// Components, and how many samples were set aside.
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
