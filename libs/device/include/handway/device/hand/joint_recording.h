#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/posture_source.h"
#include "handway/device/glove/recording.h"
#include "handway/geometric/robot/robot_model.h"

#include <filesystem>
#include <vector>

/// Recordings of a robot hand's own joints by its driver, a simulation or a data set: postures that
/// need no glove and no mapping.

namespace handway::device {

/// Reads recorded values of a hand's joints by geometric::read_joint_table(). Times are settled by
/// geometric::settle_times(); without times there are 100 rows a second. If columns have no unit,
/// angles beyond a whole turn mean that all are degrees.
///
/// Columns of other joints, velocities and efforts are ignored, and so is an incomplete last line
/// or message, as an interrupted recording leaves it. Rows that lack a value are left out; joints
/// of the hand that are missing in the file stay at RobotModel::neutral(). Warnings report all
/// that.
/// @returns angles, without sensors: a column is a variable of the hand, in its order, rad (m for
/// joints that slide).
/// @throws geometric::InputError for a file of another kind, without a joint of the hand, or
/// without a row.
[[nodiscard]] HANDWAY_DEVICE_EXPORT Recording
read_joint_recording(const std::filesystem::path& file, const geometric::RobotModel& hand);

/// Returns whether read_joint_recording() can read the file: messages of ROS, or a table that names
/// at least half of the hand's joints.
[[nodiscard]] HANDWAY_DEVICE_EXPORT bool is_joint_recording(const std::filesystem::path& file,
                                                            const geometric::RobotModel& hand);

/// The postures of such a recording: its rows, clamped to the limits.
class HANDWAY_DEVICE_EXPORT OwnJoints final : public PostureSource {
 public:
  explicit OwnJoints(const geometric::RobotModel& hand);

  [[nodiscard]] std::vector<bool> driven() const override;
  /// @pre the recording is one of read_joint_recording() for the same hand.
  [[nodiscard]] MappedPostures map_recording(const Recording& recording,
                                             const std::stop_token& stop) const override;
  using PostureSource::map_recording;
};

}  // namespace handway::device
