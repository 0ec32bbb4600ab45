#include "calibration_text_files.h"
#include "handway/device/glove/glove_calibration.h"
#include "handway/device/glove/glove_layout.h"
#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/io/text_file.h"
#include "number_text.h"
#include "yaml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace handway::device {
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

GloveCalibration read_yaml(const std::filesystem::path& file) {
  const YamlElement top = YamlElement::read(file, kWhat);
  top.allow_keys({"person", "date", "source", "sensors"});
  GloveCalibration calibration;
  calibration.person = optional_text(top, "person");
  calibration.date = optional_text(top, "date");
  calibration.source = optional_text(top, "source");
  for (const auto& [name, element] : top.need("sensors").entries()) {
    const std::optional<int> sensor = find_sensor(name);
    if (!sensor) {
      element.refuse("no sensor of that name", "a sensor of the glove",
                     geometric::advise_name(name, sensor_names()));
    }
    calibration.sensors.at(static_cast<std::size_t>(*sensor)) = read_sensor(element);
  }
  return calibration;
}

bool looks_like_yaml(const std::vector<TextLine>& lines) {
  return std::ranges::any_of(
      lines, [](const TextLine& line) { return line.text.starts_with("sensors:"); });
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
                     text_field("source", calibration.source) + "sensors:\n";
  for (std::size_t i = 0; i < kGloveSensors; ++i) {
    if (const std::optional<SensorCalibration>& sensor = calibration.sensors.at(i)) {
      text += fmt::format("  {}: {{gain: {}, zero: {}", cyberglove_sensors()[i].name, sensor->gain,
                          sensor->zero);
      text += sensor->residual ? fmt::format(", residual: {}}}\n", *sensor->residual) : "}\n";
    }
  }
  geometric::replace_file(file, text);
}

}  // namespace handway::device
