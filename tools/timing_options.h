#pragma once

#include "handway/planning/extensions/plugin.h"
#include "handway/planning/timing/time_path.h"
#include "handway/planning/timing/timing_settings.h"

#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace handway::tools {

/// Common options of `handway time` and `handway export`.
struct TimingChoice {
  std::filesystem::path path;
  std::filesystem::path scene;
  std::filesystem::path limits;
  std::filesystem::path report;
  std::vector<std::string> group;  ///< Moving joints; empty: the scene's.
  planning::TimingSettings settings;
};

void add_timing_options(CLI::App& command, TimingChoice& choice);

/// The scene's problem, from the files' present contents. @throws InputError for invalid files.
[[nodiscard]] planning::PlanningProblem read_problem(const TimingChoice& choice,
                                                     const planning::PluginManager& plugins);

/// Calls read_problem() again: the files may have been edited since.
/// @throws InputError also if the robot is not that of `before`.
[[nodiscard]] planning::PlanningProblem read_problem_again(const TimingChoice& choice,
                                                           const planning::PluginManager& plugins,
                                                           const geometric::RobotModel& before);

/// The limits of the choice's file, or of the robot if it names none.
/// @throws InputError for an invalid file.
[[nodiscard]] planning::JointKinematicLimits read_limits(const TimingChoice& choice,
                                                         const geometric::RobotModel& model);

/// Input of timing a path.
struct TimingInput {
  planning::PlanningProblem problem;
  planning::Path path;
};

/// Reads scene and path, and prints the scene's warnings. @throws InputError for invalid
/// files.
[[nodiscard]] TimingInput read_timing_input(const TimingChoice& choice,
                                            const planning::PluginManager& plugins);

/// Times the path. Writes the report if requested.
/// @param start configuration of the robot, the scene's start or as measured, with the allowed
/// distance of the path's beginning from it (rad or m).
/// @throws InputError for invalid options.
[[nodiscard]] planning::TimedPath run_timing(const TimingChoice& choice, const TimingInput& input,
                                             const planning::Configuration& start,
                                             double start_tolerance);

/// Reads scene and path and times the path from the scene's start. Writes the report if
/// requested.
/// @throws InputError for invalid files and options.
[[nodiscard]] planning::TimedPath run_timing(const TimingChoice& choice,
                                             const planning::PluginManager& plugins);

/// Prints the main results.
void print_timing(const planning::TimedPath& timed);

}  // namespace handway::tools
