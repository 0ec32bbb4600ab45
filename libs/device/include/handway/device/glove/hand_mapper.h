#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/glove_frame.h"
#include "handway/device/glove/hand_mapping.h"
#include "handway/device/glove/recording.h"
#include "handway/geometric/robot/robot_model.h"

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace handway::device {

/// The postures that a recording makes a robot's hand take.
struct MappedPostures {
  std::vector<std::string> joints;  ///< Independent joints of the hand, in the robot's order.
  Eigen::MatrixXd postures;         ///< rad, within limits, shape [samples, joints].
  /// rad, as the mapping gave them, before they were clamped to the limits.
  Eigen::MatrixXd unclamped;
  /// How many samples of each joint had to be clamped to its limits, shape [joints].
  std::vector<Eigen::Index> clamped;
};

/// A mapping made ready for a robot.
class HANDWAY_DEVICE_EXPORT HandMapper {
 public:
  /// @param hand a robot with all joints that the mapping names, such as the hand alone or
  /// an arm with it; the joints named are the hand.
  /// @throws geometric::InputError if the robot lacks a joint that the mapping names, has it
  /// coupled to another, or is the hand itself and has a joint that the mapping leaves out.
  HandMapper(const HandMapping& mapping, const geometric::RobotModel& hand);

  /// Names of the joints, in the robot's order.
  [[nodiscard]] const std::vector<std::string>& joints() const { return joints_; }
  /// Limits of the joints, shape [joints].
  [[nodiscard]] const Eigen::VectorXd& lower() const { return lower_; }
  [[nodiscard]] const Eigen::VectorXd& upper() const { return upper_; }
  /// Whether a joint is driven by a sensor, and not fixed, shape [joints].
  [[nodiscard]] std::vector<bool> driven() const;

  /// The posture for one frame of angles, clamped, shape [joints]; joints whose sensor is
  /// NaN take the middle of their range.
  [[nodiscard]] Eigen::VectorXd posture(const GloveAngles& angles) const;

  /// The posture before it is clamped to the limits, shape [joints].
  [[nodiscard]] Eigen::VectorXd unclamped(const GloveAngles& angles) const;

  /// The postures for all rows.
  /// @throws geometric::InputError if the recording holds counts, or lacks a sensor that
  /// drives a joint.
  [[nodiscard]] MappedPostures map_recording(const Recording& recording) const;

 private:
  [[nodiscard]] double value(Eigen::Index joint, double angle) const;

  std::vector<std::string> joints_;
  std::vector<JointWire> wires_;  ///< In the order of joints_.
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
};

}  // namespace handway::device
