#include "handway/device/glove/hand_mapping.h"

#include "glove/sensor_names.h"
#include "glove/text_files.h"
#include "handway/device/glove/calibration_fit.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/device/glove/human_hand.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/math/units.h"
#include "handway/geometric/robot/composed_robot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <utility>

namespace handway::device {
namespace {

using geometric::YamlElement;

std::vector<CurvePoint> read_curve(const YamlElement& element) {
  std::vector<CurvePoint> curve;
  for (const YamlElement& item : element.items()) {
    const Eigen::VectorXd point = item.numbers(2);
    if (!curve.empty() && point[0] <= curve.back().angle) {
      item.refuse(fmt::format("angle {}", point[0]),
                  fmt::format("one above {}", curve.back().angle));
    }
    curve.push_back({point[0], point[1]});
  }
  if (curve.size() < 2) {
    element.refuse(element.found(), "at least two points [angle, joint]");
  }
  return curve;
}

void read_sensor(const YamlElement& item, const YamlElement& sensor, JointMapping& mapped) {
  mapped.sensor = named_sensor(sensor, sensor.text());
  if (const std::optional<YamlElement> curve = item.find("curve")) {
    if (item.find("gain") || item.find("offset")) {
      curve->refuse("a curve beside gain or offset", "one or the other");
    }
    mapped.curve = read_curve(*curve);
  }
  mapped.gain = item.number_or("gain", 1.0);
  mapped.offset = item.number_or("offset", 0.0);
}

JointMapping read_joint_mapping(const YamlElement& item) {
  item.allow_keys({"joint", "sensor", "gain", "offset", "curve", "fixed", "arm"});
  JointMapping mapped;
  mapped.joint = item.need("joint").text();
  if (const std::optional<YamlElement> arm = item.find("arm"); arm && arm->flag()) {
    item.allow_keys({"joint", "arm"});
    mapped.left_to_arm = true;
    return mapped;
  }
  const std::optional<YamlElement> sensor = item.find("sensor");
  const std::optional<YamlElement> fixed = item.find("fixed");
  if (sensor.has_value() == fixed.has_value()) {
    item.refuse(sensor ? "sensor and fixed" : "neither sensor nor fixed", "one of them");
  }
  if (sensor) {
    read_sensor(item, *sensor, mapped);
    return mapped;
  }
  item.allow_keys({"joint", "fixed"});
  if (fixed->text() != "middle") {
    mapped.fixed = fixed->number();
  }
  return mapped;
}

std::string mapping_text(const JointMapping& mapped) {
  std::string text = fmt::format("  - {{joint: {}", mapped.joint);
  if (mapped.left_to_arm) {
    return text + ", arm: true}\n";
  }
  if (mapped.sensor < 0) {
    return text +
           (mapped.fixed ? fmt::format(", fixed: {}}}\n", *mapped.fixed) : ", fixed: middle}\n");
  }
  text += fmt::format(", sensor: {}",
                      cyberglove_sensors()[static_cast<std::size_t>(mapped.sensor)].name);
  if (mapped.curve.empty()) {
    return text + fmt::format(", gain: {}, offset: {}}}\n", mapped.gain, mapped.offset);
  }
  std::string points;
  for (const CurvePoint& point : mapped.curve) {
    points += fmt::format("{}[{}, {}]", points.empty() ? "" : ", ", point.angle, point.joint);
  }
  return text + fmt::format(", curve: [{}]}}\n", points);
}

}  // namespace

HandMapping table1_mapping() {
  const auto mapped = [](const char* joint, std::string_view letter, double gain,
                         double offset = 0.0) {
    return JointMapping{joint, find_sensor(letter).value_or(-1), gain, offset, {}, {}};
  };
  // The thumb base turns 90° and the joint after it 30° around 0 over the same roll.
  const double sixth = 15.0 * geometric::kDegree;
  return {
      "sah_right",
      "Rosell, Suarez, Rosales and Perez (2011), Table 1; c drives both thumb joints over the "
      "same part of their ranges",
      {mapped("thumb_base", "c", -1.0), mapped("thumb_abduction", "c", -1.0 / 3.0, sixth),
       mapped("thumb_proximal", "e", -1.0), mapped("thumb_medial", "f", -1.0),
       mapped("index_abduction", "j", -1.0), mapped("index_proximal", "g", -1.0),
       mapped("index_medial", "h", -1.0), JointMapping{"middle_abduction", -1, 1.0, 0.0, {}, {}},
       mapped("middle_proximal", "k", -1.0), mapped("middle_medial", "l", -1.0),
       mapped("ring_abduction", "n", 1.0), mapped("ring_proximal", "o", -1.0),
       mapped("ring_medial", "p", -1.0)}};
}

HandMapping read_mapping(const std::filesystem::path& file) {
  const YamlElement top = YamlElement::read(file, "a mapping of a glove to a hand");
  top.allow_keys({"hand", "source", "joints"});
  HandMapping mapping;
  mapping.hand = top.need("hand").text();
  mapping.source = top.text_or("source", "");
  for (const YamlElement& item : top.need("joints").items()) {
    JointMapping mapped = read_joint_mapping(item);
    if (std::ranges::count(mapping.joints, mapped.joint, &JointMapping::joint) > 0) {
      item.refuse("joint " + mapped.joint + " for the second time", "every joint once");
    }
    mapping.joints.push_back(std::move(mapped));
  }
  if (mapping.joints.empty()) {
    top.need("joints").refuse("no joints", "those of the hand");
  }
  return mapping;
}

void write_mapping(const HandMapping& mapping, const std::filesystem::path& file) {
  std::string text =
      fmt::format("hand: {}\n", mapping.hand) + text_field("source", mapping.source) + "joints:\n";
  for (const JointMapping& mapped : mapping.joints) {
    text += mapping_text(mapped);
  }
  geometric::replace_file(file, text);
}

namespace {

using geometric::InputError;
using geometric::RobotModel;

constexpr double kLeastRange = 1e-4;  // rad or m, of a joint that moves

double on_curve(const std::vector<CurvePoint>& curve, double angle) {
  if (angle <= curve.front().angle) {
    return curve.front().joint;
  }
  const auto above = std::ranges::upper_bound(curve, angle, {}, &CurvePoint::angle);
  if (above == curve.end()) {
    return curve.back().joint;
  }
  const CurvePoint& below = *(above - 1);
  return std::lerp(below.joint, above->joint, (angle - below.angle) / (above->angle - below.angle));
}

int variable_of(const RobotModel& hand, const JointMapping& mapped, const HandMapping& mapping) {
  const std::optional<int> variable = geometric::find_variable_of_part(hand, mapped.joint);
  if (!variable) {
    std::vector<std::string> names;
    names.reserve(static_cast<std::size_t>(hand.variable_count()));
    for (int i = 0; i < hand.variable_count(); ++i) {
      names.push_back(hand.variable(i).name);
    }
    throw InputError({"mapping for " + mapping.hand, "joint " + mapped.joint,
                      "no independent joint of " + hand.name(), "one of its joints",
                      geometric::advise_name(mapped.joint, names)});
  }
  return *variable;
}

void check_complete(const RobotModel& hand, const HandMapping& mapping) {
  for (int i = 0; i < hand.variable_count(); ++i) {
    const std::string& name = hand.variable(i).name;
    if (hand.upper()[i] - hand.lower()[i] < kLeastRange) {
      continue;  // it can't move, as if it were fixed
    }
    if (std::ranges::find(mapping.joints, name, &JointMapping::joint) == mapping.joints.end()) {
      throw InputError({"mapping for " + mapping.hand, "", "nothing for joint " + name,
                        "a sensor for it, or \"fixed: middle\"", ""});
    }
  }
}

}  // namespace

HandMapper::HandMapper(const HandMapping& mapping, const RobotModel& hand, bool is_hand,
                       const PersonRanges& ranges)
    : ranges_(ranges) {
  if (is_hand || hand.name() == mapping.hand) {
    check_complete(hand, mapping);
  }
  std::map<int, const JointMapping*> by_variable;
  for (const JointMapping& mapped : mapping.joints) {
    const int variable = variable_of(hand, mapped, mapping);
    if (!mapped.left_to_arm) {
      by_variable[variable] = &mapped;
    }
  }
  if (by_variable.empty()) {
    throw InputError({"mapping for " + mapping.hand, "joints", "all of them left to the arm",
                      "joints of the hand", ""});
  }
  const auto count = static_cast<Eigen::Index>(by_variable.size());
  lower_.resize(count);
  upper_.resize(count);
  for (const auto& [variable, mapped] : by_variable) {
    const auto i = static_cast<Eigen::Index>(joints_.size());
    lower_[i] = hand.lower()[variable];
    upper_[i] = hand.upper()[variable];
    joints_.push_back(mapped->joint);
    mappings_.push_back(*mapped);
  }
}

std::vector<bool> HandMapper::driven() const {
  std::vector<bool> result;
  result.reserve(mappings_.size());
  for (const JointMapping& mapped : mappings_) {
    result.push_back(mapped.sensor >= 0);
  }
  return result;
}

double HandMapper::value(Eigen::Index joint, double angle) const {
  const JointMapping& mapped = mappings_[static_cast<std::size_t>(joint)];
  const double middle = 0.5 * (lower_[joint] + upper_[joint]);
  if (mapped.sensor < 0) {
    return mapped.fixed.value_or(middle);
  }
  if (!std::isfinite(angle)) {
    return middle;
  }
  const double typical = typical_angle(ranges_, mapped.sensor, angle);
  return mapped.curve.empty() ? mapped.gain * typical + mapped.offset
                              : on_curve(mapped.curve, typical);
}

Eigen::VectorXd HandMapper::posture(const GloveAngles& angles) const {
  return unclamped(angles).cwiseMax(lower_).cwiseMin(upper_);
}

Eigen::VectorXd HandMapper::unclamped(const GloveAngles& angles) const {
  Eigen::VectorXd result(lower_.size());
  for (Eigen::Index j = 0; j < result.size(); ++j) {
    const int sensor = mappings_[static_cast<std::size_t>(j)].sensor;
    const double angle = sensor < 0 ? 0.0 : angles.angles.at(static_cast<std::size_t>(sensor));
    result[j] = value(j, angle);
  }
  return result;
}

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Many gloves, cameras and headsets don't measure palm and wrist.
bool is_of_fingers(int sensor) {
  const SensorIndices fingers = landmark_sensors();
  return std::ranges::find(fingers, sensor) != fingers.end();
}

}  // namespace

MappedPostures HandMapper::map_recording(const Recording& recording,
                                         const std::stop_token& /*stop*/) const {
  if (recording.header.kind != RecordingKind::kAngles) {
    throw InputError({"recording", "", "raw counts", "angles", "Give a calibration of the glove"});
  }
  Eigen::MatrixXd unclamped(recording.values.rows(), lower_.size());
  for (Eigen::Index j = 0; j < lower_.size(); ++j) {
    const JointMapping& mapped = mappings_[static_cast<std::size_t>(j)];
    const int column = mapped.sensor < 0 ? -1 : column_of(recording.header, mapped.sensor);
    if (mapped.sensor >= 0 && column < 0 && is_of_fingers(mapped.sensor)) {
      const auto sensor = static_cast<std::size_t>(mapped.sensor);
      throw InputError({"recording", "",
                        fmt::format("no sensor {}", cyberglove_sensors()[sensor].name),
                        "it, to drive joint " + mapped.joint,
                        "Wire the joint to another sensor in the mapping, or fix it there"});
    }
    for (Eigen::Index row = 0; row < recording.values.rows(); ++row) {
      unclamped(row, j) = value(j, column < 0 ? kNaN : recording.values(row, column));
    }
  }
  return within_limits(std::move(unclamped));
}

}  // namespace handway::device
