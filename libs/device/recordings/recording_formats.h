#pragma once

#include "recordings/array_file.h"
#include "recordings/recording_format.h"

#include <memory>
#include <vector>

/// Formats of recordings, each in a file of its own.

namespace handway::device {

/// Data sets of LeRobot, and other tables in Parquet.
[[nodiscard]] const RecordingFormat& lerobot_format();
/// Messages of a robot's joints as text: refused with advice.
[[nodiscard]] const RecordingFormat& joint_message_format();
/// Maps of a table's columns (YAML).
[[nodiscard]] const RecordingFormat& table_map_format();
/// MATLAB files of version 5 to 7.3.
[[nodiscard]] const RecordingFormat& matlab_format();
/// Arrays of NumPy (.npy, .npz).
[[nodiscard]] const RecordingFormat& numpy_format();
/// Data sets of HDF5.
[[nodiscard]] const RecordingFormat& hdf5_format();
/// Bags of ROS 1 (.bag).
[[nodiscard]] const RecordingFormat& ros1_bag_format();
/// Bags of ROS 2 in SQLite or MCAP.
[[nodiscard]] const RecordingFormat& ros_bag_format();
/// Lines of messages of OpenXR, Rokoko Studio and Manus Core.
[[nodiscard]] const RecordingFormat& hand_message_format();
/// Any JSON that contains arrays of 21 points.
[[nodiscard]] const RecordingFormat& landmark_document_format();
/// Lines of JSON with the landmarks of a hand.
[[nodiscard]] const RecordingFormat& landmark_line_format();
/// Pickles of Python: refused with advice.
[[nodiscard]] const RecordingFormat& pickle_format();
/// Handway's own recordings.
[[nodiscard]] const RecordingFormat& handway_recording_format();
/// Logs of VirtualHand.
[[nodiscard]] const RecordingFormat& virtual_hand_log_format();
/// Tables of text of other programs.
[[nodiscard]] const RecordingFormat& text_table_format();

/// Returns all formats in the order in which they are tried. The last one recognises every file.
[[nodiscard]] const std::vector<const RecordingFormat*>& recording_formats();

/// Returns the first format that recognises the file.
/// @throws InputError if the file can't be read.
[[nodiscard]] const RecordingFormat& format_of(const RecordingFile& file);

/// Opens the variables of a file; nullptr if no format with variables recognises it.
/// @throws InputError if the file is damaged.
[[nodiscard]] std::unique_ptr<ArrayFile> open_arrays(const RecordingFile& file);

}  // namespace handway::device
