#include "handway/device/glove/glove_calibration.h"

#include "glove/sensor_names.h"
#include "glove/text_files.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/resources.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// The `.cal` text files of other programs, as documented in read_calibration().

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
    const std::optional<double> angle = parse_number(parts[0]);
    const std::optional<double> counts = parse_number(parts[1]);
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

// Returns whether a line is `angle:counts angle:counts`.
bool is_point_pair(const TextLine& line) { return point_pair(line).has_value(); }

// 22 lines of two points. @param lines without empty ones.
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

// Six groups of four lines below a title. @param lines without empty ones.
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
    const std::optional<double> zero = parts.size() < 3 ? std::nullopt : parse_number(parts[1]);
    const std::optional<double> gain = parts.size() < 3 ? std::nullopt : parse_number(parts[2]);
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

constexpr double kLeastCounts = 1.0;
constexpr double kMostCounts = 255.0;

}  // namespace

GloveCalibration typical_calibration() {
  return read_calibration(geometric::resource_dir() / "calibrations" / "typical_right_hand.yaml");
}

GloveAngles to_angles(const GloveFrame& frame, const GloveCalibration& calibration) {
  GloveAngles result;
  result.time = frame.time;
  if (frame.angles) {
    result.angles = *frame.angles;
    return result;
  }
  for (std::size_t i = 0; i < kGloveSensors; ++i) {
    const std::optional<SensorCalibration>& sensor = calibration.sensors.at(i);
    result.angles.at(i) = sensor && frame.counts.at(i) > 0
                              ? sensor->gain * (frame.counts.at(i) - sensor->zero)
                              : std::numeric_limits<double>::quiet_NaN();
  }
  return result;
}

GloveFrame to_counts(const GloveAngles& angles, const GloveCalibration& calibration) {
  GloveFrame result;
  result.time = angles.time;
  for (std::size_t i = 0; i < kGloveSensors; ++i) {
    const std::optional<SensorCalibration>& sensor = calibration.sensors.at(i);
    if (sensor && std::isfinite(angles.angles.at(i))) {
      const double counts = std::round(sensor->zero + angles.angles.at(i) / sensor->gain);
      result.counts.at(i) =
          static_cast<std::uint16_t>(std::clamp(counts, kLeastCounts, kMostCounts));
    }
  }
  return result;
}

Recording to_angles(const Recording& recording, const GloveCalibration& calibration) {
  if (recording.header.kind == RecordingKind::kAngles) {
    return recording;
  }
  Recording result = recording;
  result.header.kind = RecordingKind::kAngles;
  result.header.sensors.clear();
  std::vector<Eigen::Index> columns;
  for (std::size_t column = 0; column < recording.header.sensors.size(); ++column) {
    const auto sensor = static_cast<std::size_t>(recording.header.sensors[column]);
    if (!calibration.sensors.at(sensor)) {
      result.warnings.push_back("sensor " + std::string(cyberglove_sensors()[sensor].name) +
                                " is left out: it is not calibrated");
      continue;
    }
    result.header.sensors.push_back(static_cast<int>(sensor));
    columns.push_back(static_cast<Eigen::Index>(column));
  }
  result.values.resize(recording.values.rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto sensor = static_cast<std::size_t>(result.header.sensors[i]);
    const SensorCalibration& line = calibration.sensors.at(sensor).value();
    result.values.col(static_cast<Eigen::Index>(i)) =
        line.gain * (recording.values.col(columns[i]).array() - line.zero);
  }
  return result;
}

namespace {

using geometric::YamlElement;

constexpr const char* kWhat = "a calibration of a glove";

SensorCalibration read_sensor(const YamlElement& element) {
  element.allow_keys({"gain", "zero", "residual"});
  SensorCalibration sensor;
  const YamlElement gain = element.need("gain");
  sensor.gain = gain.number();
  if (sensor.gain == 0.0) {
    gain.refuse(gain.found(), "rad per count other than 0");
  }
  sensor.zero = element.need("zero").number();
  if (const std::optional<YamlElement> residual = element.find("residual")) {
    sensor.residual = residual->number();
  }
  return sensor;
}

PersonRanges read_ranges(const YamlElement& map) {
  PersonRanges ranges;
  for (const auto& [name, element] : map.entries()) {
    const Eigen::VectorXd ends = element.numbers(2) * geometric::kDegree;
    if (!(ends[0] < ends[1])) {
      element.refuse(element.found(), "least and most, in degrees");
    }
    ranges.at(static_cast<std::size_t>(named_sensor(element, name))) = std::pair(ends[0], ends[1]);
  }
  return ranges;
}

// Missing fingers are those of a typical hand.
HandBones read_bones(const YamlElement& map) {
  map.allow_keys({"thumb", "index", "middle", "ring", "little"});
  HandBones bones = typical_bones();
  for (std::size_t f = 0; f < bones.size(); ++f) {
    if (const auto finger = map.find(name_of(static_cast<Finger>(f)))) {
      const Eigen::VectorXd lengths = finger->numbers(4) * geometric::kMillimetre;
      if (!(lengths.minCoeff() > 0.0)) {
        finger->refuse(finger->found(), "four lengths above 0, in mm");
      }
      std::ranges::copy(lengths, bones[f].begin());
    }
  }
  return bones;
}

GloveCalibration read_yaml(const std::filesystem::path& file) {
  const YamlElement top = YamlElement::read(file, kWhat);
  top.allow_keys({"person", "date", "source", "sensors", "ranges", "bones"});
  GloveCalibration calibration;
  calibration.person = top.text_or("person", "");
  calibration.date = top.text_or("date", "");
  calibration.source = top.text_or("source", "");
  if (const auto ranges = top.find("ranges")) {
    calibration.ranges = read_ranges(*ranges);
  }
  if (const auto bones = top.find("bones")) {
    calibration.bones = read_bones(*bones);
  }
  if (!top.find("sensors") && (top.find("ranges") || top.find("bones"))) {
    calibration.sensors = typical_calibration().sensors;
    return calibration;
  }
  for (const auto& [name, element] : top.need("sensors").entries()) {
    calibration.sensors.at(static_cast<std::size_t>(named_sensor(element, name))) =
        read_sensor(element);
  }
  return calibration;
}

bool looks_like_yaml(const std::vector<TextLine>& lines) {
  return std::ranges::any_of(lines, [](const TextLine& line) {
    return line.text.starts_with("sensors:") || line.text.starts_with("ranges:") ||
           line.text.starts_with("bones:");
  });
}

std::string ranges_text(const PersonRanges& ranges) {
  std::string text;
  for (std::size_t i = 0; i < kGloveSensors; ++i) {
    if (const auto& range = ranges.at(i)) {
      text += fmt::format("  {}: [{:.2f}, {:.2f}]\n", cyberglove_sensors()[i].name,
                          range->first / geometric::kDegree, range->second / geometric::kDegree);
    }
  }
  return text.empty() ? text : "ranges:\n" + text;
}

std::string bones_text(const HandBones& bones) {
  std::string text = "bones:\n";
  for (std::size_t f = 0; f < bones.size(); ++f) {
    const auto mm = [&](std::size_t i) { return bones.at(f).at(i) / geometric::kMillimetre; };
    text += fmt::format("  {}: [{:.2f}, {:.2f}, {:.2f}, {:.2f}]\n", name_of(static_cast<Finger>(f)),
                        mm(0), mm(1), mm(2), mm(3));
  }
  return text;
}

}  // namespace

GloveCalibration read_calibration(const std::filesystem::path& file) {
  const std::string text = geometric::read_text_file(file, kWhat);
  std::vector<TextLine> lines = text_lines(text);
  std::erase_if(lines, [](const TextLine& line) { return trimmed(line.text).empty(); });
  if (lines.empty()) {
    throw geometric::InputError({file.string(), "", "blank lines alone", kWhat, ""});
  }
  if (looks_like_yaml(lines)) {
    return read_yaml(file);
  }
  return is_point_pair(lines.front()) ? read_point_pairs(file, lines)
                                      : read_virtual_hand_calibration(file, lines);
}

void write_calibration(const GloveCalibration& calibration, const std::filesystem::path& file) {
  std::string text = text_field("person", calibration.person) +
                     text_field("date", calibration.date) +
                     text_field("source", calibration.source);
  std::string sensors;
  for (std::size_t i = 0; i < kGloveSensors; ++i) {
    if (const std::optional<SensorCalibration>& sensor = calibration.sensors.at(i)) {
      sensors += fmt::format("  {}: {{gain: {}, zero: {}", cyberglove_sensors()[i].name,
                             sensor->gain, sensor->zero);
      sensors += sensor->residual ? fmt::format(", residual: {}}}\n", *sensor->residual) : "}\n";
    }
  }
  text += sensors.empty() ? sensors : "sensors:\n" + sensors;
  text += ranges_text(calibration.ranges);
  text += calibration.bones ? bones_text(*calibration.bones) : "";
  geometric::replace_file(file, text);
}

}  // namespace handway::device
