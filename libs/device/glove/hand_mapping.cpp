#include "handway/device/glove/hand_mapping.h"

#include "glove/sensor_names.h"
#include "glove/text_files.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/math/units.h"

#include <fmt/format.h>

#include <algorithm>
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

}  // namespace handway::device
