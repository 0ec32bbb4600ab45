#include "commands.h"
#include "handway/execution/motion/motion_target.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"
#include "motion_sending.h"
#include "printing.h"
#include "terminal.h"
#include "timing_options.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace handway::tools {
namespace {

struct SendCommand {
  TimingChoice timing;
  SendOptions options;
};

// The scene as its files are now, which may have changed since the path was timed. A robot that
// differs from the timed motion's, or can't run it, is refused.
execution::SceneWatch::Problem scene_now(const TimingChoice& choice,
                                         const planning::PluginManager& plugins,
                                         const planning::Motion& motion) {
  auto problem = std::make_shared<const planning::PlanningProblem>(
      read_problem_again(choice, plugins, *motion.model));
  const geometric::RobotModel& model = problem->model();
  planning::JointKinematicLimits limits = read_limits(choice, model);
  if (!choice.settings.jerk) {
    limits.jerk.resize(0);
  }
  const auto faults = check_trajectory(model, motion.trajectory, limits);
  if (!faults.empty()) {
    throw geometric::InputError({choice.scene.string(), "robot", faults.front().text,
                                 "a motion within the limits",
                                 "The files were edited in the meantime: send the path again."});
  }
  return problem;
}

int send(const SendCommand& command) {
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  const geometric::FilesRead notes;
  const TimingInput input = read_timing_input(command.timing, plugins);
  std::vector<execution::MotionTarget> targets =
      execution::parse_targets(command.options.to, input.problem);
  execution::check_that_the_rest_stands(input.problem.model(), input.path, targets);
  std::stop_source stop;
  const StopsOnInterrupt guard(stop);
  if (!connect(targets, stop.get_token())) {
    return end_before_the_start();
  }
  const planning::TimedPath timed = run_timing(
      command.timing, input, execution::with_measured(input.path.waypoints.front(), targets),
      command.options.tolerances.start);
  print_timing(timed);
  if (!timed.cleared()) {
    return kNoPath;
  }
  const auto read_scene = [&](const std::stop_token& /*stop*/) {
    return scene_now(command.timing, plugins, timed.motion);
  };
  Sending sending{.parts = {{.trajectory = timed.motion.trajectory, .scene = read_scene}},
                  .speed = command.timing.settings.speed,
                  .files = see_files(notes.files()),  // before they are read once more
                  .on_edit = [&](execution::SceneWatch& watch) { watch.follow(read_scene); }};
  return send_parts(command.options, targets, std::move(sending), stop);
}

}  // namespace

void add_send_command(CLI::App& app, int& exit_code) {
  auto choice = std::make_shared<SendCommand>();
  choice->timing.settings.speed = kCautiousSpeed;
  choice->timing.settings.period = kPointPeriod;
  CLI::App* command =
      app.add_subcommand("send", "Run a path on an arm, a hand, both, or a robot in ROS");
  add_timing_options(*command, choice->timing);
  add_send_options(*command, choice->options)->required();
  command->callback([choice, &exit_code] { exit_code = send(*choice); });
}

}  // namespace handway::tools
