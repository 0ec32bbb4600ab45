#pragma once

#include "recordings/array_file.h"
#include "recordings/message_reader.h"

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

/// Rows of numbers in the messages of a topic of ROS.

namespace handway::device {

/// Collects the rows of one topic.
class TopicRows {
 public:
  virtual ~TopicRows() = default;

  /// Adds the rows of a message.
  /// @param received s since 1970, the time of messages without a stamp.
  /// @throws MessageError if it is damaged.
  virtual void add(std::string_view message, double received) = 0;
  /// The size of the rows so far, without their number.
  [[nodiscard]] virtual std::vector<std::size_t> row_shape() const = 0;
  [[nodiscard]] virtual std::size_t row_count() const = 0;
  [[nodiscard]] virtual std::vector<std::string> names() const { return {}; }
  /// The rows with their times; values that were not received before are NaN.
  [[nodiscard]] virtual Series series() const = 0;
};

/// Returns rows for the messages of a type, as "sensor_msgs/msg/JointState" of ROS 2 or
/// "sensor_msgs/JointState" of ROS 1; nullptr for a type that is not read.
/// @param topic its name, by which poses are called.
[[nodiscard]] std::unique_ptr<TopicRows> rows_of_type(std::string_view type, std::string_view topic,
                                                      MessageEncoding encoding);

/// Returns whether messages of a type are poses of bodies or frames.
[[nodiscard]] bool is_pose_type(std::string_view type);

/// Returns whether messages of a type often are of other things than recordings: poses and markers.
[[nodiscard]] bool is_incidental_type(std::string_view type);

}  // namespace handway::device
