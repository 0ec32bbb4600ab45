#pragma once

#include "handway/geometric/io/yaml_element.h"
#include "handway/geometric/robot/robot_model.h"

#include <string>

namespace handway::geometric {

/// A map of joint names to values (rad, m), laid over `defaults`. A coupled
/// joint may be named too: it then gives its leader's value, or must agree with
/// it (within 1e-6).
/// @param defaults shape [variable_count].
/// @throws InputError naming the line, for unknown and fixed joints and for
/// coupled joints that contradict each other.
[[nodiscard]] Configuration configuration_of(const YamlElement& element, const RobotModel& model,
                                             const Configuration& defaults);

/// A map of joint names to values (rad, m), as configuration_of() takes it.
/// @returns the values of the variables that it gives; without a group.
/// @throws InputError as configuration_of().
[[nodiscard]] NamedPosture posture_of(const YamlElement& element, const RobotModel& model,
                                      const std::string& name);

}  // namespace handway::geometric
