#include "glove/finger_bending.h"
#include "handway/device/core/line_protocol.h"
#include "handway/device/glove/human_hand.h"
#include "handway/device/glove/landmark_line.h"
#include "handway/geometric/io/input_error.h"
#include "recordings/landmark_recording.h"
#include "recordings/recorded_rows.h"
#include "recordings/recording_formats.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <optional>
#include <string>

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

bool is_landmark_row(const TextLine& line) { return trimmed(line.text).starts_with('{'); }

Recording read_landmark_recording(const std::filesystem::path& file,
                                  const std::vector<TextLine>& lines) {
  Recording recording;
  recording.header = landmark_header(file);
  struct Seen {
    TextLine line;
    double time;
    HandLandmarks points;
  };
  std::vector<Seen> seen;
  std::optional<bool> left;
  int others = 0;
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
    seen.push_back({line, *row.time, *row.landmarks});
  };
  const auto is_row = [](const TextLine& line) { return nlohmann::json::accept(line.text); };
  take_rows(file, lines, recording.warnings, is_row, take);
  if (others > 0) {
    recording.warnings.push_back(
        fmt::format("{}: {} rows of the {} hand left out, the first is of "
                    "the {} one",
                    file.string(), others, *left ? "right" : "left", *left ? "left" : "right"));
  }
  double as_labelled = 0.0;
  double as_other = 0.0;
  for (const Seen& row : seen) {
    as_labelled += bending(row.points, *left);
    as_other += bending(row.points, !*left);
  }
  constexpr double kClearly = 0.3;  // rad, of all fingers together
  if (as_other - as_labelled > kClearly * static_cast<double>(seen.size())) {
    left = !*left;
    recording.warnings.push_back(fmt::format(
        "{}: labelled as a {} hand, but taken for a {} one: its fingers would bend backwards",
        file.string(), *left ? "right" : "left", *left ? "left" : "right"));
  }
  RecordedRows rows(file, recording.header.sensors.size());
  std::vector<HandBones> bones;
  for (const Seen& row : seen) {
    bones.push_back(bones_of(row.points));
    rows.add(row.line, row.time, landmark_row(recording.header, row.points, *left));
  }
  rows.move_to(recording);
  recording.bones = median_bones(bones);
  return recording;
}

class LandmarkLines final : public RecordingFormat {
 public:
  [[nodiscard]] RecordingKindOfFile kind() const override {
    return {"landmark lines", "Lines of JSON with 21 landmarks of a hand in m."};
  }
  [[nodiscard]] bool recognises(const RecordingFile& file) const override {
    const TextLine* first = file.first_line();
    return first != nullptr && is_landmark_row(*first);
  }
  [[nodiscard]] Recording read(const RecordingFile& file) const override {
    return read_landmark_recording(file.path(), file.lines());
  }
};

}  // namespace

const RecordingFormat& landmark_line_format() {
  static const LandmarkLines kFormat;
  return kFormat;
}

}  // namespace handway::device
