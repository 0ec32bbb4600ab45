#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/retargeting/fingertip_retargeter.h"

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace handway::device {

/// Distances of fingertips from FingertipRetargeter::wanted(), over all fingers and postures,
/// m.
struct FingertipErrors {
  double mean = 0.0;
  double median = 0.0;
  double most = 0.0;  ///< Bound of 95 % of them.
};

/// Compares postures of a robot's hand, from any source, with measurements of a person's hand.
/// @param rows the measurements; at least one.
/// @param joints names of the postures' joints; those that the hand lacks are ignored, and the
/// hand's others are in the middle of their ranges.
/// @param postures rad, shape [rows, joints].
[[nodiscard]] HANDWAY_DEVICE_EXPORT FingertipErrors
fingertip_errors(std::span<const GloveAngles> rows, const std::vector<std::string>& joints,
                 const Eigen::MatrixXd& postures, const FingertipRetargeter& hand);

/// Returns a function from a posture of a source's joints, normalised to [0, 1] by their limits,
/// shape [joints], to the fingertips: in the frame of the hand's palm, m, a column for each finger.
/// Joints as in fingertip_errors().
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::function<Eigen::Matrix3Xd(const Eigen::VectorXd&)>
normalised_fingertips(const std::shared_ptr<const FingertipRetargeter>& hand,
                      const PostureSource& source);

}  // namespace handway::device
