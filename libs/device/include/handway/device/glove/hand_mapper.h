#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/device/glove/posture_source.h"
#include "handway/geometric/robot/robot_model.h"

#include <Eigen/Core>

#include <stop_token>
#include <vector>

namespace handway::device {

/// A mapping prepared for a robot.
class HANDWAY_DEVICE_EXPORT HandMapper : public PostureSource {
 public:
  /// @param hand a robot with all joints that the mapping names, such as the hand alone or an arm
  /// with it; the joints named, but for those left to the arm, form the hand.
  /// @param is_hand the robot is the mapping's hand, whatever its name; else only if the names are
  /// equal.
  /// @param ranges of the person: angles go to the joints as those of a typical hand (see
  /// typical_angle()).
  /// @throws geometric::InputError if the robot lacks a joint that the mapping names, has it
  /// coupled to another, or is the hand itself and has a joint that the mapping leaves out; or if
  /// all are left to the arm.
  HandMapper(const HandMapping& mapping, const geometric::RobotModel& hand, bool is_hand = false,
             const PersonRanges& ranges = {});

  [[nodiscard]] std::vector<bool> driven() const override;

  /// The posture for one frame of angles, clamped, shape [joints]; joints whose sensor is
  /// NaN take the middle of their range.
  [[nodiscard]] Eigen::VectorXd posture(const GloveAngles& angles) const;

  /// The posture before it is clamped to the limits, shape [joints].
  [[nodiscard]] Eigen::VectorXd unclamped(const GloveAngles& angles) const;

  using PostureSource::map_recording;
  /// Joints of palm and wrist whose sensor the recording lacks take the middle of their range.
  [[nodiscard]] MappedPostures map_recording(const Recording& recording,
                                             const std::stop_token& stop) const override;

 private:
  [[nodiscard]] double value(Eigen::Index joint, double angle) const;

  std::vector<JointMapping> mappings_;  ///< In the order of joints().
  PersonRanges ranges_;
};

}  // namespace handway::device
