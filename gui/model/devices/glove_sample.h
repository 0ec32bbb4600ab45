#pragma once

#include "handway/device/glove/glove_frame.h"

#include <Eigen/Core>

#include <vector>

namespace handway::gui {

/// One frame of a glove, and what calibration and mapping make of it.
struct GloveSample {
  device::GloveFrame frame;
  device::GloveAngles angles;
  Eigen::VectorXd unclamped;  ///< rad, as mapped, shape [mapped joints]; empty without mapping.
  Eigen::VectorXd posture;    ///< rad, within limits, shape [mapped joints].
};

}  // namespace handway::gui
