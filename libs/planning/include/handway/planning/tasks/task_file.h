#pragma once

#include "handway/geometric/scene/scene.h"
#include "handway/planning/export.h"
#include "handway/planning/tasks/task.h"

#include <filesystem>
#include <string>
#include <vector>

namespace handway::planning {

/// The version of the task format that this program reads.
inline constexpr int kTaskVersion = 1;

/// Reads a task file (YAML; docs/tasks.md): `handway_task: 1` and `steps`, a list of maps with one
/// key each. Lengths are in m, angles in degrees.
/// Steps are those of geometric::program_steps_of().
/// @param scene whose objects and postures the steps name.
/// @throws InputError naming file, line and element of the error.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Task read_task(const std::filesystem::path& file,
                                                     const geometric::Scene& scene);

/// Returns the steps of a program of the scene as a task, without those that are disabled. A list
/// of alternatives in which all steps are disabled is left out, too.
/// @throws InputError for a posture that scene and robot lack, naming those that there are.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Task task_of(const geometric::Program& program,
                                                   const geometric::Scene& scene);

/// Returns the program of the scene called `name`, or its only one if `name` is empty.
/// @throws InputError naming the programs that there are.
[[nodiscard]] HANDWAY_PLANNING_EXPORT Task program_task(const geometric::Scene& scene,
                                                        const std::string& name);

/// Returns the names of the postures that a step can move to: "start", then those of the scene and
/// of its first robot, each once.
/// @pre the scene has a robot.
[[nodiscard]] HANDWAY_PLANNING_EXPORT std::vector<std::string> posture_names(
    const geometric::Scene& scene);

/// Returns the step that moves the first robot to a posture of the scene or of the robot, or to the
/// start of the scene if `name` is "start". Joints that the posture does not name stay at the
/// start's values.
/// @throws InputError naming the postures that there are. @param source of the name, for messages.
[[nodiscard]] HANDWAY_PLANNING_EXPORT MoveStep move_to_posture(const geometric::Scene& scene,
                                                               const std::string& name,
                                                               const std::string& source);

}  // namespace handway::planning
