#pragma once

#include "handway/planning/extensions/plugin.h"
#include "handway/planning/tasks/task.h"
#include "scene_file_watch.h"

#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace handway::tools {

/// A task to be planned, from the command line.
struct TaskRequest {
  std::filesystem::path scene;
  std::filesystem::path task;  ///< A program of the scene, or a file; empty: the steps below.
  std::string pick;
  std::vector<std::string> place_on;
  std::vector<double> place_at;  ///< m, and degrees; empty: not given.
  std::string then;              ///< Posture at the end; empty: none.
  std::string planner;
  std::vector<std::string> settings;
  std::vector<std::string> group;
  planning::TaskOptions options = {.threads = 2};
};

/// A task of a scene.
struct LoadedTask {
  planning::SceneState state;
  planning::Task task;
  std::vector<SeenFile> files;  ///< Files of the scene, as they were read.
};

/// A planned task.
struct RequestedTask {
  planning::Task task;
  planning::TaskPlan plan;
  std::vector<SeenFile> files;  ///< Files of the scene, as they were read.
};

/// Adds the scene and the options of a task.
void add_task_request(CLI::App& command, TaskRequest& request);

/// Reads the scene and prints its warnings.
/// @throws InputError for invalid files and steps, CLI::Error if nothing says what the task is.
[[nodiscard]] LoadedTask load_requested(TaskRequest& request,
                                        const planning::PluginManager& plugins);

/// Returns the planner of the motions that are not straight.
[[nodiscard]] std::unique_ptr<planning::Planner> planner_of(const TaskRequest& request,
                                                            const planning::SceneState& state,
                                                            const planning::PluginManager& plugins);

/// Reads the scene, prints its warnings and plans the task.
/// @param stop ends the search.
/// @throws InputError for invalid files and steps, CLI::Error if nothing says what the task is.
[[nodiscard]] RequestedTask plan_requested(TaskRequest& request,
                                           const planning::PluginManager& plugins,
                                           const std::stop_token& stop);

/// Prints why a task is not solved, stage by stage. @returns the exit code.
[[nodiscard]] int print_failure(const planning::Task& task, const planning::TaskPlan& plan);

}  // namespace handway::tools
