#pragma once

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace handway::geometric {

/// Reads the list `robots` of a scene file, and mounts robots on each other.
/// @param folder of the scene file.
/// @returns the elements of the robots that stand in the world, in the order of scene.robots: that
/// of the list, what carries a robot in the place of that robot.
/// @throws InputError naming the line.
[[nodiscard]] std::vector<YamlElement> read_robots(const YamlElement& list,
                                                   const std::filesystem::path& folder,
                                                   Scene& scene);

/// A map of joint names to values (rad, m), laid over `defaults`. A coupled
/// joint may be named too: it then gives its leader's value, or must agree with
/// it (within 1e-6).
/// @param defaults shape [variable_count].
/// @param part of a composed robot: its joints may go by their own names; nullptr: none may.
/// @throws InputError naming the line, for unknown and fixed joints and for
/// coupled joints that contradict each other.
[[nodiscard]] Configuration configuration_of(const YamlElement& element, const RobotModel& model,
                                             const Configuration& defaults,
                                             const RobotPart* part = nullptr);

/// The link that the named joint carries. @throws InputError if there is none or it is fixed.
[[nodiscard]] int carried_link(const YamlElement& element, const RobotModel& model,
                               const std::string& name);

/// @throws InputError, always: robots and objects have names of their own.
[[noreturn]] void refuse_second_name(const YamlElement& element, const std::string& name);

}  // namespace handway::geometric
