#pragma once

#include "handway/geometric/formats/yaml_element.h"

#include <string>
#include <vector>

/// What this folder's YAML files share.
namespace handway::device {

/// The text of a key; empty if there is none.
[[nodiscard]] std::string optional_text(const geometric::YamlElement& map, const std::string& key);

/// `key: "text"` as a line; nothing for an empty text.
[[nodiscard]] std::string text_field(const std::string& key, const std::string& text);

/// Of all sensors, for advice on misspelt ones.
[[nodiscard]] std::vector<std::string> sensor_names();

}  // namespace handway::device
