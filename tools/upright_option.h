#pragma once

#include "handway/planning/core/importer.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace handway::tools {

/// Adds `--upright OBJECT:DEGREES`, which may be given several times.
void add_upright_option(CLI::App& command, std::vector<std::string>& uprights);

/// Adds a constraint to the scene for each OBJECT:DEGREES that the option took: the z axis of the
/// object, or of the robot's link of that name, stays within that angle of the world's.
/// @throws InputError if the robot has no such link and carries no such object.
void add_uprights(const std::vector<std::string>& uprights, planning::LoadedScene& scene);

}  // namespace handway::tools
