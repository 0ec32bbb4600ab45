#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/recording.h"

#include <Eigen/Core>

#include <stop_token>
#include <string>
#include <vector>

namespace handway::device {

/// Postures of a robot's hand mapped from a recording.
struct MappedPostures {
  std::vector<std::string> joints;  ///< Independent joints of the hand, in the robot's order.
  Eigen::MatrixXd postures;         ///< rad, within limits, shape [samples, joints].
  /// rad, before they were clamped to the limits.
  Eigen::MatrixXd unclamped;
  /// Number of samples of each joint that had to be clamped to its limits, shape [joints].
  std::vector<Eigen::Index> clamped;
};

/// Maps measurements on a human hand to postures of a robot hand.
class HANDWAY_DEVICE_EXPORT PostureSource {
 public:
  virtual ~PostureSource() = default;

  /// Names of the joints, in the robot's order.
  [[nodiscard]] const std::vector<std::string>& joints() const { return joints_; }
  /// Limits of the joints, rad or m, shape [joints].
  [[nodiscard]] const Eigen::VectorXd& lower() const { return lower_; }
  [[nodiscard]] const Eigen::VectorXd& upper() const { return upper_; }

  /// True for each joint that follows the human hand, and is not fixed, shape [joints].
  [[nodiscard]] virtual std::vector<bool> driven() const = 0;
  /// Maps all rows to postures.
  /// @param stop cancels the mapping: then rows may be missing at the end.
  /// @throws geometric::InputError if the recording holds counts, or lacks a sensor that is needed.
  [[nodiscard]] virtual MappedPostures map_recording(const Recording& recording,
                                                     const std::stop_token& stop) const = 0;
  [[nodiscard]] MappedPostures map_recording(const Recording& recording) const {
    return map_recording(recording, {});
  }

 protected:
  PostureSource() = default;
  PostureSource(const PostureSource&) = default;
  PostureSource(PostureSource&&) = default;
  PostureSource& operator=(const PostureSource&) = default;
  PostureSource& operator=(PostureSource&&) = default;

  /// Clamps postures to the limits, and counts those outside.
  /// @param unclamped shape [samples, joints].
  [[nodiscard]] MappedPostures within_limits(Eigen::MatrixXd unclamped) const;

  std::vector<std::string> joints_;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
};

}  // namespace handway::device
