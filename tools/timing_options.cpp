#include "timing_options.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/planning/extensions/load_scene.h"
#include "handway/planning/extensions/plugin.h"
#include "parameter_options.h"
#include "printing.h"
#include "scene_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace handway::tools {
void add_timing_options(CLI::App& command, TimingChoice& choice) {
  command.add_option("path", choice.path, "Path (CSV)")->required();
  command.add_option("--scene", choice.scene, "Scene or problem file of the path")->required();
  add_parameter_options(command, parameters_of(choice.settings));
  command.get_option("--no-blend")->excludes(command.get_option("--deviation"));
  command.add_option(
      "--limits", choice.limits,
      "Velocity, acceleration and jerk limits that replace the robot's (joint_limits.yaml)");
  add_group_option(command, choice.group);
  command.add_option("--report", choice.report, "File for the pre-flight report (JSON)");
}

planning::PlanningProblem read_problem(const TimingChoice& choice,
                                       const planning::PluginManager& plugins) {
  planning::SceneState loaded = planning::load_scene(choice.scene, plugins);
  set_group(choice.group, loaded);
  return planning::make_problem(loaded.scene, loaded.basis, {}, planning::GoalNeed::kOptional);
}

planning::PlanningProblem read_problem_again(const TimingChoice& choice,
                                             const planning::PluginManager& plugins,
                                             const geometric::RobotModel& before) {
  planning::PlanningProblem problem = read_problem(choice, plugins);
  const geometric::RobotModel& model = problem.model();
  bool is_same = model.variable_count() == before.variable_count();
  for (int v = 0; is_same && v < model.variable_count(); ++v) {
    is_same = model.variable(v).name == before.variable(v).name;
  }
  if (!is_same) {
    throw geometric::InputError({choice.scene.string(), "robot", "other joints than before",
                                 "the robot that the path was read for",
                                 "The files were edited meanwhile: start again."});
  }
  return problem;
}

planning::JointKinematicLimits read_limits(const TimingChoice& choice,
                                           const geometric::RobotModel& model) {
  return choice.limits.empty() ? planning::rate_limits(model)
                               : planning::read_joint_kinematic_limits(model, choice.limits);
}

TimingInput read_timing_input(const TimingChoice& choice, const planning::PluginManager& plugins) {
  planning::PlanningProblem problem = read_problem(choice, plugins);
  print_warnings(problem);
  planning::Path path = read_path(problem, choice.path);
  return {std::move(problem), std::move(path)};
}

planning::TimedPath run_timing(const TimingChoice& choice, const planning::PluginManager& plugins) {
  const TimingInput input = read_timing_input(choice, plugins);
  // A continuous joint of the scene's start stands for all its turns.
  const planning::Configuration start =
      input.problem.model().nearest_equivalent(input.path.waypoints.front(), input.problem.start);
  return run_timing(choice, input, start, planning::TimingOptions{}.start_tolerance);
}

planning::TimedPath run_timing(const TimingChoice& choice, const TimingInput& input,
                               const planning::Configuration& start, double start_tolerance) {
  planning::TimingOptions options = timing_options(choice.settings, input.problem.model());
  options.measured_start = start;
  options.start_tolerance = start_tolerance;
  options.limits = read_limits(choice, input.problem.model());
  planning::TimedPath timed = time_path(
      input.problem, input.path, planning::motion_name(choice.path.stem().string()), options);
  if (!timed.blends.fault.empty()) {
    timed.preflight.faults.push_back({"", 0.0, 0.0, timed.blends.fault});
  }
  if (!choice.report.empty()) {
    geometric::replace_file(choice.report, planning::to_json(timed.preflight));
  }
  return timed;
}

void print_timing(const planning::TimedPath& timed) {
  if (!timed.blends.fault.empty()) {
    print_out("{}\nNOT CLEARED: the path itself is in collision\n", timed.blends.fault);
    return;
  }
  print_out("{}", planning::to_text(timed.preflight));
  print_out("{} waypoints, {} stops between", timed.motion.path.waypoints.size(),
            timed.blends.stops);
  if (timed.blends.arcs > 0) {
    print_out(", {} arcs ({} smaller than requested); largest distance from a waypoint {:.4f} rad",
              timed.blends.arcs, timed.blends.reduced, timed.blends.largest_deviation);
  }
  print_out("\n");
  if (timed.least_duration > 0.0) {
    print_out("lower bound of the duration for these waypoints: {:.3f} s\n", timed.least_duration);
  }
}

}  // namespace handway::tools
