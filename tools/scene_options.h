#pragma once

#include "handway/geometric/scene/scene.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/edits/scene_state.h"
#include "handway/planning/planners/planner.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace handway::tools {

/// Takes `basis=FILE` out of the settings, and replaces the scene's basis by that one. FILE is a
/// path or the name of a basis that ships.
/// @throws InputError if it can't be read or is for another hand than the scene's basis.
void choose_basis(std::vector<std::string>& settings, planning::SceneState& scene);

/// The planner called `name` (empty: the scene's, or else the first in the registry). The scene's
/// settings are applied if they are for it; another planner's are ignored.
/// @throws InputError for an unknown planner or setting.
[[nodiscard]] std::unique_ptr<planning::Planner> scene_planner(
    const std::string& name, const geometric::PlannerRequest& choice,
    const planning::PlannerRegistry& registry);

/// Sets parameters from the command line, KEY=VALUE each.
/// @throws CLI::ValidationError if one is not of this form, InputError for an unknown parameter or
/// an invalid value.
void apply_settings(planning::Planner& planner, const std::vector<std::string>& settings);

/// Prints the readers' warnings as one summary on stderr; nothing if there are none.
void print_warnings(const geometric::Scene& scene);
/// Prints the warnings of the problem's scene and its own.
void print_warnings(const planning::PlanningProblem& problem);

/// The path of a file; joints that it lacks stay at the problem's start, with a note on the error
/// output. @throws InputError as planning::read_path().
[[nodiscard]] planning::Path read_path(const planning::PlanningProblem& problem,
                                       const std::filesystem::path& file);

/// Adds `--upright OBJECT:DEGREES`, a repeatable option.
void add_upright_option(CLI::App& command, std::vector<std::string>& uprights);

/// Adds a constraint to the scene for each OBJECT:DEGREES of the option: the z axis of the object,
/// or of the robot's link of that name, stays within that angle of the world's.
/// @throws InputError if the robot has no such link and carries no such object.
void add_uprights(const std::vector<std::string>& uprights, planning::SceneState& scene);

/// Adds `--group`, names with commas between them, a repeatable option.
void add_group_option(CLI::App& command, std::vector<std::string>& group);

/// Replaces the scene's group (geometric::set_moving_group()); does nothing without names. @throws
/// InputError for a name that no robot of the scene has.
void set_group(const std::vector<std::string>& group, planning::SceneState& scene);

}  // namespace handway::tools
