#include "task_request.h"

#include "commands.h"
#include "handway/geometric/io/text_file.h"
#include "handway/geometric/math/pose.h"
#include "handway/geometric/math/units.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "handway/planning/tasks/task_file.h"
#include "numbers.h"
#include "parameter_options.h"
#include "printing.h"
#include "scene_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace handway::tools {
namespace {

planning::Task task_of(const TaskRequest& request, const geometric::Scene& scene) {
  if (!request.task.empty()) {
    const bool is_program =
        std::ranges::count(scene.programs, request.task.string(), &geometric::Program::name) > 0;
    return is_program ? planning::program_task(scene, request.task.string())
                      : planning::read_task(request.task, scene);
  }
  if (request.pick.empty() && request.then.empty()) {
    if (scene.programs.empty()) {
      throw CLI::RequiredError("--task, --pick or --then, or a program in the scene,");
    }
    return planning::program_task(scene, "");
  }
  planning::Task task;
  if (!request.pick.empty()) {
    task.emplace_back(planning::PickStep{request.pick});
  }
  if (!request.place_on.empty() || !request.place_at.empty()) {
    planning::PlaceStep place{request.place_on};
    if (!request.place_at.empty()) {
      const std::vector<double>& n = request.place_at;
      place.pose = geometric::pose_from_rpy({n[0], n[1], n[2]}, geometric::radians(n[3]),
                                            geometric::radians(n[4]), geometric::radians(n[5]));
    }
    task.emplace_back(place);
  }
  if (!request.then.empty()) {
    task.emplace_back(planning::move_to_posture(scene, request.then, "--then"));
  }
  return task;
}

void print_trials(const planning::Task& task, const planning::TaskPlan& plan) {
  for (const planning::StageTrials& trials : plan.trials) {
    print_out("  {:<24} {:<9} {:>3} tried, {:>3} failed{}\n", to_string(task[trials.step]),
              to_string(trials.kind), trials.tried, trials.failed,
              trials.reason.empty() ? std::string() : ": " + trials.reason);
  }
}

}  // namespace

void add_task_request(CLI::App& command, TaskRequest& request) {
  command.add_option("scene", request.scene, "Scene or problem file")->required();
  CLI::Option* file = command.add_option("--task", request.task,
                                         "Program of the scene by its name, or a task file (YAML)");
  CLI::Option* pick = command.add_option("--pick", request.pick, "Object to grasp")->excludes(file);
  command
      .add_option("--place-on", request.place_on,
                  "Object on which the grasped object is placed, anywhere; if given several times, "
                  "on the first on which that is possible")
      ->needs(pick)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      .add_option("--place-at", request.place_at,
                  "Pose at which it is placed, in the world or, with --place-on, in that object's "
                  "frame, m and degrees")
      ->type_name("X,Y,Z,ROLL,PITCH,YAW")
      ->delimiter(',')
      ->expected(6)
      ->check(number_in(-1e3, 1e3))
      ->needs(pick);
  command
      .add_option("--then", request.then,
                  "Posture at the end: start, or one of the scene or the robot")
      ->excludes(file);
  command.add_option(
      "--planner", request.planner,
      "Planner of the motions that are not straight (default: the scene's, else auto)");
  command
      .add_option("--set", request.settings,
                  "Parameter of the planner, KEY=VALUE; or a hand basis, basis=FILE")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_seed_option(command, request.options.seed);
  add_threads_option(command, request.options.threads, "the result");
  add_parameter_options(command, parameters_of(request.options));
  add_group_option(command, request.group);
}

LoadedTask load_requested(TaskRequest& request, const planning::PluginManager& plugins) {
  const geometric::FilesRead notes;
  LoadedTask loaded{planning::load_scene(request.scene, plugins), {}, {}};
  choose_basis(request.settings, loaded.state);
  set_group(request.group, loaded.state);
  print_warnings(*loaded.state.scene);
  loaded.task = task_of(request, *loaded.state.scene);
  loaded.files = see_files(notes.files());
  return loaded;
}

std::unique_ptr<planning::Planner> planner_of(const TaskRequest& request,
                                              const planning::SceneState& state,
                                              const planning::PluginManager& plugins) {
  std::unique_ptr<planning::Planner> planner =
      scene_planner(request.planner, state.scene->planner, plugins.planners());
  apply_settings(*planner, request.settings);
  return planner;
}

RequestedTask plan_requested(TaskRequest& request, const planning::PluginManager& plugins,
                             const std::stop_token& stop) {
  LoadedTask loaded = load_requested(request, plugins);
  const auto planner = planner_of(request, loaded.state, plugins);
  planning::TaskPlan plan = plan_task(loaded.state, loaded.task, *planner, request.options, stop);
  return {std::move(loaded.task), std::move(plan), std::move(loaded.files)};
}

int print_failure(const planning::Task& task, const planning::TaskPlan& plan) {
  print_error("handway: {}\n", plan.reason);
  print_trials(task, plan);
  return plan.start_is_valid ? kNoPath : kInvalidQuery;
}

}  // namespace handway::tools
