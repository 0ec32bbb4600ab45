#pragma once

#include "glove/text_files.h"
#include "handway/device/glove/recording.h"

#include <filesystem>
#include <vector>

/// The kinds of file that read_recording() distinguishes; messages as documented there.

namespace handway::device {

/// The first line of every recording of Handway.
inline constexpr const char* kRecordingMark = "# handway glove recording 1";

/// CSV with a header: Handway's own recordings, and others.
[[nodiscard]] Recording read_csv_recording(const std::filesystem::path& file,
                                           const std::vector<TextLine>& lines);

/// Whether a line is a row of a VirtualHand log.
[[nodiscard]] bool is_virtual_hand_row(const TextLine& line);

/// Rows of date, time, switch and 23 angles.
[[nodiscard]] Recording read_virtual_hand_log(const std::filesystem::path& file,
                                              const std::vector<TextLine>& lines);

/// Whether a line is a row of landmarks: JSON.
[[nodiscard]] bool is_landmark_row(const TextLine& line);

/// Rows of 21 landmarks of a hand, as JSON lines; the recording holds the angles between them.
[[nodiscard]] Recording read_landmark_recording(const std::filesystem::path& file,
                                                const std::vector<TextLine>& lines);

/// "FILE:LINE".
[[nodiscard]] std::string at_line(const std::filesystem::path& file, const TextLine& line);

/// Rows gathered while reading, and the checks that all formats share.
class RecordedRows {
 public:
  RecordedRows(const std::filesystem::path& file, std::size_t columns);

  /// @param row time and values. @throws InputError if time runs backwards.
  void add(const TextLine& line, double time, const std::vector<double>& values);
  /// Into the times and values of a recording. @throws InputError if there are no rows.
  void move_to(Recording& recording);

 private:
  const std::filesystem::path& file_;
  std::size_t columns_;
  std::vector<double> times_;
  std::vector<double> values_;  ///< Row by row.
};

}  // namespace handway::device
