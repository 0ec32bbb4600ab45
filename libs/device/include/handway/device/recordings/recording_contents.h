#pragma once

#include "handway/device/export.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

/// Contents of recording files, and the kinds of file that are read.
///
/// Some files hold several variables: arrays of numbers (NumPy, HDF5, MATLAB), episodes (LeRobot)
/// or topics (ROS bags). A variable is chosen by its name behind a `#`:
/// "run.h5#/observations/qpos".

namespace handway::device {

/// A variable of a recording file.
struct RecordingVariable {
  std::string name;                ///< "angles", "/observations/qpos", "q{1,2}", "/joint_states".
  std::vector<std::size_t> shape;  ///< Rows first; for topics the number of messages.
  std::string type;                ///< "float64", "text", "sensor_msgs/msg/JointState".
  std::string problem;             ///< Reason why it can't be read; empty if it can.
};

/// Returns "name (400 x 22)".
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::string to_string(const RecordingVariable& variable);

/// A kind of recording file.
struct RecordingKindOfFile {
  std::string name;         ///< "NumPy arrays".
  std::string description;  ///< One sentence.
};

/// Contents of a file without its values.
struct RecordingContents {
  RecordingKindOfFile kind;
  std::vector<RecordingVariable> variables;  ///< Empty for kinds of file with one table.
};

/// Returns the kinds of file that read_recording() and read_recorded_table() distinguish, in the
/// order in which they are tried.
[[nodiscard]] HANDWAY_DEVICE_EXPORT std::vector<RecordingKindOfFile> recording_kinds_of_file();

/// Returns the kind of a recording file and its variables. Values are not read.
/// @throws geometric::InputError if the file can't be read or is damaged.
[[nodiscard]] HANDWAY_DEVICE_EXPORT RecordingContents
recording_contents(const std::filesystem::path& file);

/// Returns whether a file or folder is a recording by its contents. A table of text may be one or
/// not: it is none here.
/// @throws geometric::InputError if the file can't be read.
[[nodiscard]] HANDWAY_DEVICE_EXPORT bool is_recording(const std::filesystem::path& file);

}  // namespace handway::device
