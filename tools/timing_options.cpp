#include "timing_options.h"

#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/math/units.h"
#include "numbers.h"
#include "printing.h"
#include "scene_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace handway::tools {
void add_timing_options(CLI::App& command, TimingChoice& choice) {
  command.add_option("path", choice.path, "Path (CSV)")->required();
  command.add_option("--scene", choice.scene, "Scene or problem file of the path")->required();
  command.add_option("--speed", choice.speed, "Share of the full speed, above 0, at most 1")
      ->check(positive_number())
      ->check(CLI::Range(0.001, 1.0))
      ->capture_default_str();
  command.add_option("--period-ms", choice.period_ms, "Time from one point to the next, ms")
      ->check(positive_number())
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  auto* deviation =
      command
          .add_option("--deviation", choice.deviation,
                      "Largest distance of an arc from its waypoint, rad over all joints together")
          ->check(positive_number())
          ->check(CLI::Range(1e-4, 10.0))
          ->capture_default_str();
  command
      .add_option("--arc-clearance-mm", choice.arc_clearance_mm,
                  "Least clearance of arcs, mm; arcs with less clearance are made smaller")
      ->check(positive_number())
      ->check(CLI::Range(0.05, 1000.0))
      ->capture_default_str();
  command.add_flag("--no-blend", choice.no_blend, "No arcs: stop at every waypoint")
      ->excludes(deviation);
  command.add_flag("--jerk", choice.jerk, "Also limit jerk");
  command.add_option(
      "--limits", choice.limits,
      "Velocity, acceleration and jerk limits that replace the robot's (joint_limits.yaml)");
  command
      .add_option("--margin", choice.margin_mm,
                  "Clearance in mm that has to remain if the robot is off by its following error; "
                  "less is cleared with a warning")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  command
      .add_option("--following-error", choice.following_error,
                  "Following error of joints at their velocity limit, rad or m (default: 0.01 rad, "
                  "0.001 m)")
      ->check(CLI::Range(0.0, 1.0));
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
  return run_timing(choice, input, input.problem.start, planning::TimingOptions{}.start_tolerance);
}

planning::TimedPath run_timing(const TimingChoice& choice, const TimingInput& input,
                               const planning::Configuration& start, double start_tolerance) {
  planning::TimingOptions options;
  options.speed = choice.speed;
  options.period = 1e-3 * choice.period_ms;
  options.blends.deviation = choice.no_blend ? 0.0 : choice.deviation;
  options.blends.arc_clearance = geometric::metres(choice.arc_clearance_mm);
  options.limit_jerk = choice.jerk;
  options.measured_start = start;
  options.start_tolerance = start_tolerance;
  options.limits = read_limits(choice, input.problem.model());
  options.safety.margin = geometric::metres(choice.margin_mm);
  if (choice.following_error >= 0.0) {
    options.safety.following_error =
        Eigen::VectorXd::Constant(input.problem.model().variable_count(), choice.following_error);
  }
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
