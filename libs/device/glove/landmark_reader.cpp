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

bool is_landmark_row(const TextLine& line) { return trimmed(line.text).starts_with('{'); }

Recording read_landmark_recording(const std::filesystem::path& file,
                                  const std::vector<TextLine>& lines) {
  Recording recording;
  recording.header.kind = RecordingKind::kAngles;
  recording.header.device = "landmarks of a hand";
  recording.header.origin = file.filename().string();
  recording.header.sensors = landmark_sensors();
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
    const GloveAngles angles = glove_angles(in_palm_frame(*row.landmarks, row.left));
    bones.push_back(bones_of(*row.landmarks));
    std::vector<double> values;
    for (const int sensor : recording.header.sensors) {
      values.push_back(angles.angles.at(static_cast<std::size_t>(sensor)));
    }
    rows.add(line, *row.time, values);
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
