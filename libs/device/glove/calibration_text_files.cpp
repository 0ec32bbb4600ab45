#include "calibration_text_files.h"

#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/io/input_error.h"
#include "number_text.h"
#include "recording_readers.h"
#include "virtual_hand_sign.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace handway::device {
namespace {

using geometric::InputError;

constexpr double kNearestPoints = 10.0;  // counts
constexpr std::size_t kGroups = 6;
constexpr std::size_t kLinesPerGroup = 4;

// Sensors by line: wrist, thumb, index, middle (its second: palm), ring, little finger.
constexpr std::array<int, kGloveSensors> kSensorOfLine{21, 20, 3, 0,  1,  2,  4,  10, 5,  6,  7,
                                                       19, 8,  9, 11, 14, 12, 13, 15, 18, 16, 17};

struct PointPair {
  std::array<double, 2> angles;
  std::array<double, 2> counts;
};

std::optional<PointPair> point_pair(const TextLine& line) {
  const std::vector<std::string_view> points = cells(line.text, ' ');
  if (points.size() != 2) {
    return std::nullopt;
  }
  PointPair pair{};
  for (std::size_t i = 0; i < 2; ++i) {
    const std::vector<std::string_view> parts = cells(points[i], ':');
    if (parts.size() != 2) {
      return std::nullopt;
    }
    const std::optional<double> angle = finite_number(parts[0]);
    const std::optional<double> counts = finite_number(parts[1]);
    if (!angle || !counts) {
      return std::nullopt;
    }
    pair.angles.at(i) = *angle;
    pair.counts.at(i) = *counts;
  }
  return pair;
}

std::optional<int> sensor_of_slot(std::size_t slot) {
  for (std::size_t i = 0; i < cyberglove_sensors().size(); ++i) {
    if (cyberglove_sensors()[i].slot == static_cast<int>(slot)) {
      return static_cast<int>(i);
    }
  }
  return std::nullopt;
}

}  // namespace

bool is_point_pair(const TextLine& line) { return point_pair(line).has_value(); }

GloveCalibration read_point_pairs(const std::filesystem::path& file,
                                  const std::vector<TextLine>& lines) {
  if (lines.size() != kSensorOfLine.size()) {
    throw InputError({file.string(), "", fmt::format("{} lines of points", lines.size()),
                      fmt::format("{}, one per sensor", kSensorOfLine.size()), ""});
  }
  GloveCalibration calibration;
  calibration.source = file.filename().string();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::optional<PointPair> pair = point_pair(lines[i]);
    if (!pair) {
      throw InputError({at_line(file, lines[i]), "",
                        fmt::format("\"{:.40}\"", trimmed(lines[i].text)),
                        "\"angle:counts angle:counts\"", ""});
    }
    const auto sensor = static_cast<std::size_t>(kSensorOfLine.at(i));
    const double span = pair->counts[1] - pair->counts[0];
    const double sign = virtual_hand_sign(kSensorOfLine.at(i));
    const double gain = sign * (pair->angles[1] - pair->angles[0]) / span;
    if (std::abs(span) < kNearestPoints || gain == 0.0) {
      throw InputError({at_line(file, lines[i]), std::string(cyberglove_sensors()[sensor].name),
                        fmt::format("points {} counts apart", std::abs(span)),
                        fmt::format("different angles, {} counts apart or more", kNearestPoints),
                        "Calibrate again with the hand opened and closed fully"});
    }
    calibration.sensors.at(sensor) =
        SensorCalibration{gain, pair->counts[0] - sign * pair->angles[0] / gain, std::nullopt};
  }
  return calibration;
}

GloveCalibration read_virtual_hand_calibration(const std::filesystem::path& file,
                                               const std::vector<TextLine>& lines) {
  constexpr std::size_t kLines = 1 + kGroups * (1 + kLinesPerGroup);
  if (lines.size() < kLines) {
    throw InputError({file.string(), "", fmt::format("{} lines", lines.size()),
                      "a calibration: YAML with the key sensors, 22 lines \"angle:counts "
                      "angle:counts\", or a title and six groups of a name and four lines",
                      ""});
  }
  GloveCalibration calibration;
  calibration.source = file.filename().string();
  for (std::size_t slot = 0; slot < kGroups * kLinesPerGroup; ++slot) {
    const TextLine& line = lines[2 + slot + slot / kLinesPerGroup];
    const std::vector<std::string_view> parts = cells(line.text, ' ');
    const std::optional<double> zero = parts.size() < 3 ? std::nullopt : finite_number(parts[1]);
    const std::optional<double> gain = parts.size() < 3 ? std::nullopt : finite_number(parts[2]);
    if (!zero || !gain) {
      throw InputError({at_line(file, line), "", fmt::format("\"{:.40}\"", trimmed(line.text)),
                        "\"index zero gain x\"", ""});
    }
    const std::optional<int> sensor = sensor_of_slot(slot);
    if (sensor && *gain != 0.0) {
      calibration.sensors.at(static_cast<std::size_t>(*sensor)) =
          SensorCalibration{virtual_hand_sign(*sensor) * *gain, *zero, std::nullopt};
    }
  }
  return calibration;
}

}  // namespace handway::device
