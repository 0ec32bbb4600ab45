#include "glove/recording_readers.h"
#include "handway/device/core/line_protocol.h"
#include "handway/device/glove/human_hand.h"
#include "handway/device/glove/landmark_line.h"
#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace handway::device {
namespace {

LandmarkLine read_row(const std::filesystem::path& file, const TextLine& line) {
  try {
    LandmarkLine row = read_landmark_line(trimmed(line.text));
    if (!row.time) {
      throw LineProtocolError("no key \"time\"");
    }
    return row;
  } catch (const LineProtocolError& error) {
    throw geometric::InputError(
        {at_line(file, line), "", error.what(), "a row of landmarks",
         "A row is {\"time\": s, \"hand\": \"right\", \"landmarks\": 21 points in m}."});
  }
}

}  // namespace

RecordingHeader landmark_header(const std::filesystem::path& file) {
  RecordingHeader header;
  header.kind = RecordingKind::kAngles;
  header.device = "landmarks of a hand";
  header.origin = file.filename().string();
  header.sensors = landmark_sensors();
  return header;
}

std::vector<double> landmark_row(const RecordingHeader& header, const HandLandmarks& points,
                                 bool left) {
  const GloveAngles angles = glove_angles(in_palm_frame(points, left));
  std::vector<double> row;
  for (const int sensor : header.sensors) {
    row.push_back(angles.angles.at(static_cast<std::size_t>(sensor)));
  }
  return row;
}

bool is_landmark_row(const TextLine& line) { return trimmed(line.text).starts_with('{'); }

Recording read_landmark_recording(const std::filesystem::path& file,
                                  const std::vector<TextLine>& lines) {
  Recording recording;
  recording.header = landmark_header(file);
  RecordedRows rows(file, recording.header.sensors.size());
  std::optional<bool> left;
  int others = 0;
  std::vector<HandBones> bones;
  const auto take = [&](const TextLine& line) {
    const LandmarkLine row = read_row(file, line);
    if (!row.landmarks) {
      return;
    }
    left = left.value_or(row.left);
    if (row.left != *left) {
      ++others;
      return;
    }
    bones.push_back(bones_of(*row.landmarks));
    rows.add(line, *row.time, landmark_row(recording.header, *row.landmarks, row.left));
  };
  const auto is_row = [](const TextLine& line) { return nlohmann::json::accept(line.text); };
  take_rows(file, lines, recording.warnings, is_row, take);
  if (others > 0) {
    recording.warnings.push_back(
        fmt::format("{}: {} rows of the {} hand left out, the first is of "
                    "the {} one",
                    file.string(), others, *left ? "right" : "left", *left ? "left" : "right"));
  }
  rows.move_to(recording);
  recording.bones = median_bones(bones);
  return recording;
}

}  // namespace handway::device
