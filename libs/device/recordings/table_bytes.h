#pragma once

#include "handway/device/recordings/recorded_table.h"

#include <string>

/// Files of a table, as bytes: see write_recorded_table().

namespace handway::device {

[[nodiscard]] std::string npz_bytes(const RecordedTable& table);

/// A bag of ROS 2 with a message for each row and topic: `NAME.x`, `.y`, `.z`, `.qx`, `.qy`, `.qz`,
/// `.qw` become a geometry_msgs/PoseStamped `/NAME` in the frame `world`, all other columns the
/// positions of a sensor_msgs/JointState `/joint_states`. Times that no stamp can hold begin at 0.
[[nodiscard]] std::string mcap_bytes(const RecordedTable& table);

/// A table of doubles: `time_s` and a column for each of the table.
[[nodiscard]] std::string parquet_bytes(const RecordedTable& table);

/// From any thread.
[[nodiscard]] std::string hdf5_bytes(const RecordedTable& table);

}  // namespace handway::device
