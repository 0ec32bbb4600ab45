#include "handway/device/glove/recording.h"

#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/text_file.h"
#include "number_text.h"
#include "recording_readers.h"
#include "recording_text.h"

#include <algorithm>
#include <stdexcept>

namespace handway::device {
namespace {

constexpr std::size_t kLargestFile = std::size_t{1} << 30;  // some 30 hours at 100 Hz

}  // namespace

std::string to_string(RecordingKind kind) {
  return kind == RecordingKind::kCounts ? "counts" : "angles";
}

int column_of(const RecordingHeader& header, int sensor) {
  const auto found = std::ranges::find(header.sensors, sensor);
  return found == header.sensors.end() ? -1 : static_cast<int>(found - header.sensors.begin());
}

Recording read_recording(const std::filesystem::path& file) {
  const std::string text = geometric::read_text_file(file, "a recording of a glove", kLargestFile);
  const std::vector<TextLine> lines = text_lines(text);
  const auto first =
      std::ranges::find_if(lines, [](const TextLine& line) { return !trimmed(line.text).empty(); });
  return first != lines.end() && is_virtual_hand_row(*first) ? read_virtual_hand_log(file, lines)
                                                             : read_csv_recording(file, lines);
}

void write_recording(const Recording& recording, const std::filesystem::path& file) {
  const Eigen::Index rows = recording.times.size();
  if (recording.values.rows() != rows) {
    throw std::invalid_argument("a recording needs a time for every row");
  }
  std::string text = header_text(recording.header);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const Eigen::VectorXd values = recording.values.row(row);
    text += row_text(recording.header, recording.times[row],
                     {values.data(), static_cast<std::size_t>(values.size())});
  }
  geometric::replace_file(file, text);
}

}  // namespace handway::device
