#include "glove/recording_readers.h"
#include "handway/device/glove/human_hand.h"
#include "handway/geometric/io/input_error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace handway::device {
namespace {

using geometric::InputError;
using Json = nlohmann::json;

constexpr double kLongestHand = 0.5;  // m from wrist to a fingertip

/// A row of landmarks.
struct LandmarkRow {
  double time = 0.0;  ///< s
  bool left = false;
  HandLandmarks landmarks;
};

[[noreturn]] void refuse(const std::filesystem::path& file, const TextLine& line,
                         const std::string& element, const std::string& found,
                         const std::string& expected) {
  throw InputError({at_line(file, line), element, found, expected,
                    "A row is {\"time\": s, \"hand\": \"right\", \"landmarks\": 21 points in m}."});
}

double coordinate(const Json& point, int axis) {
  constexpr std::array kNames{"x", "y", "z"};
  const auto index = static_cast<std::size_t>(axis);
  return point.is_object() ? point.at(kNames.at(index)).get<double>()
                           : point.at(index).get<double>();
}

// @throws nlohmann's exceptions for what is no such row.
LandmarkRow parse_row(const Json& json) {
  LandmarkRow row;
  row.time = json.at("time").get<double>();
  row.left = json.value("hand", "right") == "left";
  const Json& points = json.at("landmarks");
  if (points.size() != static_cast<std::size_t>(row.landmarks.cols())) {
    throw std::invalid_argument(fmt::format("{} landmarks", points.size()));
  }
  for (int i = 0; i < row.landmarks.cols(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      row.landmarks(axis, i) = coordinate(points.at(static_cast<std::size_t>(i)), axis);
    }
  }
  return row;
}

LandmarkRow read_row(const std::filesystem::path& file, const TextLine& line) {
  try {
    LandmarkRow row = parse_row(Json::parse(line.text));
    const double reach = (row.landmarks.colwise() - row.landmarks.col(kWristLandmark).eval())
                             .colwise()
                             .norm()
                             .maxCoeff();
    if (!(reach <= kLongestHand)) {
      refuse(file, line, "landmarks", fmt::format("a hand of {:.3g} m", reach),
             fmt::format("metres: a hand of at most {} m", kLongestHand));
    }
    return row;
  } catch (const Json::exception& error) {
    refuse(file, line, "", error.what(), "a row of landmarks");
  } catch (const std::invalid_argument& error) {
    refuse(file, line, "landmarks", error.what(), "21 points of a hand");
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
  for (int sensor = 0; sensor < kGloveSensors; ++sensor) {
    if (measured_by_landmarks(sensor)) {
      recording.header.sensors.push_back(sensor);
    }
  }
  RecordedRows rows(file, recording.header.sensors.size());
  for (const TextLine& line : lines) {
    if (trimmed(line.text).empty()) {
      continue;
    }
    if (!line.ended && !Json::accept(line.text)) {
      recording.warnings.push_back(at_line(file, line) + ": left out, the row is cut off");
      break;
    }
    const LandmarkRow row = read_row(file, line);
    GloveAngles angles;
    try {
      angles = glove_angles(in_palm_frame(row.landmarks, row.left));
    } catch (const std::invalid_argument& error) {
      refuse(file, line, "landmarks", error.what(), "21 points of a hand");
    }
    std::vector<double> values;
    for (const int sensor : recording.header.sensors) {
      values.push_back(angles.angles.at(static_cast<std::size_t>(sensor)));
    }
    rows.add(line, row.time, values);
  }
  rows.move_to(recording);
  return recording;
}

}  // namespace handway::device
