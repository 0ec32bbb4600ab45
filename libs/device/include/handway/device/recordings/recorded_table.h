#pragma once

#include "handway/device/export.h"
#include "handway/device/glove/recording.h"

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Recordings of anything with named columns over time: of a glove or of a robot's joints.

namespace handway::device {

/// Rows over time.
struct RecordedTable {
  std::vector<std::string> names;                       ///< Names of the columns.
  Eigen::VectorXd times;                                ///< s, never falling, shape [rows].
  Eigen::MatrixXd values;                               ///< Finite, shape [rows, columns].
  std::vector<std::string> warnings;                    ///< What was left out or inferred.
  std::optional<RecordingHeader> glove = std::nullopt;  ///< Header of a glove's recording.
  /// Columns of the source, a row for each of `values`, if these were derived from others.
  std::optional<RawColumns> raw = std::nullopt;
};

/// Reads any recording: one of a glove, of landmarks, or of a robot's joints, whatever the robot.
/// Values of joints are in the file's unit. Rows with gaps are left out. Columns without names are
/// called "joint_1", "joint_2", …
/// @param file a file of read_recording() or read_joint_recording(), with a variable behind a `#`.
/// @throws geometric::InputError naming file and variables if it has no or several tables.
[[nodiscard]] HANDWAY_DEVICE_EXPORT RecordedTable
read_recorded_table(const std::filesystem::path& file);

/// Joins tables with the same columns: each begins one step after the end of the one before. Raw
/// columns are joined by their names and units; values that a table lacks are missing.
/// @param files for messages, one for each table.
/// @throws geometric::InputError naming the file whose columns differ from the first.
/// @throws std::invalid_argument if there is no table, or sizes differ.
[[nodiscard]] HANDWAY_DEVICE_EXPORT RecordedTable
joined_tables(std::span<const RecordedTable> tables, std::span<const std::filesystem::path> files);

/// Endings of the files that write_recorded_table() writes.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::vector<std::string> recorded_table_endings();

/// Replaces a file whole, by its ending:
///   - `.csv`: a recording of Handway if the table is of a glove, else a header and rows;
///   - `.npz`: arrays `time` (s), `values` [rows, columns] and `names` of NumPy, and `raw` and
///     `raw_names` ("NAME [UNIT]") of the source's columns;
///   - `.h5`, `.hdf5`: data sets of these names;
///   - `.mcap`: a bag of ROS 2, poses (`NAME.x`, `.y`, `.z`, `.qx`, `.qy`, `.qz`, `.qw`) as
///     geometry_msgs/PoseStamped `/NAME`, all else as sensor_msgs/JointState `/joint_states`; the
///     source's columns as sensor_msgs/JointState `/raw`;
///   - `.parquet`: a table with `time_s` and the columns, of doubles.
/// Equal tables give equal bytes.
/// @throws geometric::OutputError if the file can't be written or has another ending.
HANDWAY_DEVICE_EXPORT void write_recorded_table(const RecordedTable& table,
                                                const std::filesystem::path& file);

}  // namespace handway::device
