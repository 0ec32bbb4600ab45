#pragma once

#include "handway/geometric/io/yaml_element.h"
#include "handway/planning/core/parameter.h"

#include <string>
#include <vector>

namespace handway::planning {

/// The values that a campaign gives a parameter: one, a list, or a range
/// `{from: A, to: B, steps: N, scale: linear|log}` with both ends. Each is text that the
/// parameter has accepted; in a range of a whole-numbered parameter they are rounded, and
/// those that fall together are taken once. At least one.
/// @throws InputError naming the element.
[[nodiscard]] std::vector<std::string> parameter_values(const geometric::YamlElement& element,
                                                        const Parameter& parameter);

/// The whole number or number that an element holds, within bounds.
/// @throws InputError naming the element.
[[nodiscard]] double bounded_number(const geometric::YamlElement& element, double lower,
                                    double upper, bool whole);

}  // namespace handway::planning
