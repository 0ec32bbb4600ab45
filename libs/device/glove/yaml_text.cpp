#include "yaml_text.h"

#include "handway/device/glove/glove_layout.h"

#include <optional>

namespace handway::device {

std::string optional_text(const geometric::YamlElement& map, const std::string& key) {
  const std::optional<geometric::YamlElement> value = map.find(key);
  return value ? value->text() : "";
}

std::string text_field(const std::string& key, const std::string& text) {
  if (text.empty()) {
    return "";
  }
  std::string quoted;
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
    }
    quoted += c == '\n' || c == '\r' ? ' ' : c;
  }
  return key + ": \"" + quoted + "\"\n";
}

std::vector<std::string> sensor_names() {
  std::vector<std::string> names;
  for (const GloveSensor& sensor : cyberglove_sensors()) {
    names.emplace_back(sensor.name);
  }
  return names;
}

}  // namespace handway::device
