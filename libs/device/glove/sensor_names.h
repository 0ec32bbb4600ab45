#pragma once

#include "handway/geometric/formats/yaml_element.h"

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Names of the sensors of gloves, in Handway and in other programs.

namespace handway::device {

/// Names of all sensors, for advice on misspelt ones.
[[nodiscard]] std::vector<std::string> sensor_names();

/// Index of the sensor with that name, or with that one letter, used in `element`.
/// @throws InputError about the element if the name is unknown.
[[nodiscard]] int named_sensor(const geometric::YamlElement& element, const std::string& name);

/// Index of the sensor with that name in any program or data set.
[[nodiscard]] std::optional<int> sensor_by_any_name(const std::string& name);

/// The words of a column's name: letters and digits, in small letters.
[[nodiscard]] std::vector<std::string> words_of_name(std::string_view name);
/// Returns whether one of `words` is among `any`.
[[nodiscard]] bool has_word(const std::vector<std::string>& words,
                            std::initializer_list<const char*> any);

}  // namespace handway::device
