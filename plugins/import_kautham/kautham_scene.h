#pragma once

#include "handway/planning/core/importer.h"
#include "kautham_problem.h"

namespace handway::import_kautham {

/// Opens all files that the problem names and puts the scene together. The first
/// robot is the one to plan for; `basis` is its hand's.
/// @throws InputError if one of the files can't be read, or the query's number
/// of controls is not that of the robots.
[[nodiscard]] planning::LoadedScene make_scene(const KauthamProblem& problem);

/// A scene with just this robot, all controls in the middle, nothing around it.
/// @param file a `.rob` file.
[[nodiscard]] planning::LoadedScene make_robot_scene(const std::filesystem::path& file);

}  // namespace handway::import_kautham
