#pragma once

#include "features/glove/captured_postures.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/posture_source.h"
#include "handway/geometric/robot/robot_model.h"
#include "handway/sampling/postures/basis_study.h"

#include <Eigen/Core>

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

namespace handway::gui {

/// Recordings, of one person or of several, as postures of a hand.
struct PostureRecordings {
  CapturedPostures postures;                       ///< Postures of all recordings, joined.
  std::vector<sampling::RecordedHand> each;        ///< Postures of each recording.
  std::vector<device::GloveAngles> measured = {};  ///< Evenly chosen rows of all, in their order.
  std::vector<std::string> warnings = {};          ///< Warnings about interpretations in reading.
};

/// Returns a posture normalised to [0, 1], shape [joints]. @param source of the posture.
[[nodiscard]] Eigen::VectorXd normalised(const device::PostureSource& source,
                                         const Eigen::VectorXd& posture);

/// Reads recordings as postures normalised to [0, 1]: those of a glove through calibration and
/// mapping or retargeting, those of the robot hand's own joints as they are.
/// @param left_out as for CapturedPostures.
/// @param hand that has the joints.
/// @param stop requested if the result is not needed any more.
/// @throws geometric::InputError if one can't be read or lacks a sensor.
[[nodiscard]] PostureRecordings read_postures(const std::vector<std::filesystem::path>& files,
                                              const device::GloveCalibration& calibration,
                                              const device::PostureSource& source,
                                              const std::vector<int>& left_out,
                                              const geometric::RobotModel& hand,
                                              const std::stop_token& stop = {});

}  // namespace handway::gui
