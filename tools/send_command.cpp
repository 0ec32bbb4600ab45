#include "commands.h"
#include "handway/execution/motion/motion_log.h"
#include "handway/execution/motion/motion_run.h"
#include "handway/execution/motion/motion_target.h"
#include "handway/execution/motion/scene_watch.h"
#include "handway/geometric/io/input_error.h"
#include "handway/geometric/io/text_file.h"
#include "numbers.h"
#include "printing.h"
#include "scene_file_watch.h"
#include "terminal.h"
#include "timing_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace handway::tools {
namespace {

using execution::MotionTarget;

// A tenth of the pace by default; at 20 ms an arm's queue of ten points does not run
// empty.
constexpr double kCautiousSpeed = 0.1;
constexpr double kPointPeriod = 0.02;    // s
constexpr double kProgressPeriod = 0.5;  // s

struct SendChoice {
  TimingChoice timing;
  std::string to;
  std::filesystem::path log;
  device::MotionTolerances tolerances;
  bool yes = false;
};

// Writes the log, and prints the motion's progress now and then. A motion that was paused because
// the scene was edited continues if the rest is free, and else ends.
class SendObserver final : public execution::MotionObserver {
 public:
  SendObserver(const std::vector<MotionTarget>& targets, execution::MotionLog& log,
               execution::MotionRequests& requests, std::stop_source& stop)
      : targets_(targets), log_(log), requests_(requests), stop_(stop) {}

  // Object of the scene that ended the motion.
  [[nodiscard]] const std::string& obstacle() const { return obstacle_; }

  void on_sample(const execution::MotionSample& sample) override {
    log_.add(sample.time, sample.target, sample.planned, sample.measured);
  }
  void on_held(const std::string& reason) override {
    print_out("paused: {}\n", reason);
    std::fflush(stdout);
  }
  void on_progress(double time, const std::vector<execution::FollowingError>& errors) override {
    if (requests_.hold) {
      end_hold(time);
    }
    if (time < next_) {
      return;
    }
    next_ += kProgressPeriod;
    std::string line =
        fmt::format("{:.1f} of {:.1f} s", time, targets_.front().link->trajectory().duration());
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      line +=
          fmt::format(", {} error up to {:.4f} rad", targets_[i].kind, errors[i].max().maxCoeff());
    }
    print_out("{}\n", line);
    std::fflush(stdout);
  }

 private:
  void end_hold(double time) {
    execution::SceneWatch& watch = *requests_.watch;
    const execution::SceneVerdict rest =
        watch.look(time, execution::with_measured(watch.start(), targets_));
    if (rest.state == execution::SceneVerdict::State::kBlocked) {
      obstacle_ = rest.reason;
      stop_.request_stop();
    } else if (rest.state == execution::SceneVerdict::State::kFree) {
      requests_.hold = false;
    }
  }

  const std::vector<MotionTarget>& targets_;
  execution::MotionLog& log_;
  execution::MotionRequests& requests_;
  std::stop_source& stop_;
  std::string obstacle_;
  double next_ = kProgressPeriod;
};

void print_errors(const std::vector<MotionTarget>& targets,
                  const execution::MotionOutcome& outcome) {
  print_out("following error, rad:\n{:<24}{:>10}{:>10}\n", "", "max", "RMS");
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Eigen::VectorXd rms = outcome.errors[i].rms();
    for (Eigen::Index j = 0; j < rms.size(); ++j) {
      print_out("{:<24}{:>10.5f}{:>10.5f}\n",
                targets[i].link->joints().names[static_cast<std::size_t>(j)],
                outcome.errors[i].max()[j], rms[j]);
    }
  }
}

const char* cause_of(const execution::MotionOutcome& outcome) {
  if (!outcome.collision.empty()) {
    return "because of the scene";
  }
  return outcome.fault.empty() ? "on request" : "after a fault";
}

int report(const std::vector<MotionTarget>& targets, const execution::MotionOutcome& outcome,
           const execution::MotionLog& log, double duration) {
  print_errors(targets, outcome);
  if (!log.good()) {
    print_error("The log could not be written to its end.\n");
  }
  if (outcome.done) {
    print_out("done: {:.2f} s\n", duration);
    return log.good() ? kDone : kInvalidInput;
  }
  std::fflush(stdout);
  if (!outcome.collision.empty()) {
    print_error("{}\n", outcome.collision);
  }
  if (!outcome.fault.empty()) {
    print_error("{}\n", outcome.fault);
  }
  print_out("STOPPED at {:.2f} of {:.2f} s: {}; STOP sent to all devices within {:.1f} ms, ",
            outcome.time, duration, cause_of(outcome), outcome.stop_sent_ms);
  if (outcome.at_rest_ms >= 0.0) {
    print_out("at rest {:.0f} ms later\n", outcome.at_rest_ms);
  } else {
    print_out("not confirmed at rest: LOOK AT THE ROBOT\n");
  }
  return kMotionStopped;
}

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

// @returns whether all were connected before a stop was requested.
bool connect(const std::vector<MotionTarget>& targets, const std::stop_token& stop) {
  try {
    for (const MotionTarget& target : targets) {
      target.link->connect(stop);
    }
  } catch (const std::exception&) {
    if (!stop.stop_requested()) {  // else that is what the device did not stand
      throw;
    }
  }
  return !stop.stop_requested();
}

int end_before_the_start() {
  print_error("Nothing moved: stopped before the start.\n");
  return kMotionStopped;
}

int send(const SendChoice& choice) {
  planning::PluginManager plugins;
  plugins.load_plugins(planning::plugin_directory());
  const geometric::FilesRead notes;
  const TimingInput input = read_timing_input(choice.timing, plugins);
  std::vector<MotionTarget> targets = execution::parse_targets(choice.to, input.problem);
  execution::check_that_the_rest_stands(input.problem.model(), input.path, targets);
  std::stop_source stop;
  const StopsOnInterrupt guard(stop);
  if (!connect(targets, stop.get_token())) {
    return end_before_the_start();
  }
  const planning::TimedPath timed = run_timing(
      choice.timing, input, execution::with_measured(input.path.waypoints.front(), targets),
      choice.tolerances.start);
  print_timing(timed);
  if (!timed.cleared()) {
    return kNoPath;
  }
  const double duration = timed.motion.trajectory.duration();
  for (const MotionTarget& target : targets) {
    print_out("{}: {} joints, {} points, {:.2f} s at {:g} % speed\n", target.link->name(),
              target.variables.size(), timed.motion.trajectory.points.size(), duration,
              100.0 * choice.timing.settings.speed);
  }
  if (!choice.yes) {
    print_error("Nothing was sent. Add --yes to let the robot move.\n");
    return kWrongUsage;
  }
  std::fflush(stdout);
  execution::MotionLog log(choice.log, targets);
  for (const MotionTarget& target : targets) {
    // Timing took a while, during which the link was not polled.
    target.link->update();
    target.link->upload(execution::part_of(timed.motion.trajectory, target.variables));
  }
  if (stop.stop_requested()) {
    return end_before_the_start();
  }
  const auto read_scene = [&](const std::stop_token& /*stop*/) {
    return scene_now(choice.timing, plugins, timed.motion);
  };
  std::vector<SeenFile> seen = see_files(notes.files());  // before they are read once more
  execution::SceneWatch watch(timed.motion.trajectory, read_scene);
  const SceneFileWatch edits(std::move(seen), [&] { watch.follow(read_scene); });
  execution::MotionRequests requests{.stop = stop.get_token(), .watch = &watch};
  SendObserver observer(targets, log, requests, stop);
  execution::MotionOutcome outcome = run_motion(targets, choice.tolerances, requests, observer);
  if (outcome.collision.empty()) {
    outcome.collision = observer.obstacle();
  }
  if (!outcome.started) {
    print_error("Nothing moved: {}\n",
                outcome.collision.empty() ? "stopped before the start." : outcome.collision);
    return outcome.collision.empty() ? kMotionStopped : kNoPath;
  }
  return report(targets, outcome, log, duration);
}

}  // namespace

void add_send_command(CLI::App& app, int& exit_code) {
  auto choice = std::make_shared<SendChoice>();
  choice->timing.settings.speed = kCautiousSpeed;
  choice->timing.settings.period = kPointPeriod;
  CLI::App* command =
      app.add_subcommand("send", "Run a path on an arm, a hand, both, or a robot in ROS");
  add_timing_options(*command, choice->timing);
  command
      ->add_option("--to", choice->to,
                   "Device: arm://HOST[:PORT], hand://HOST[:PORT], both separated by a comma, or "
                   "ros://HOST[:PORT][/CONTROLLER][#arm|#hand] (ros2:// for ROS 2)")
      ->required();
  command->add_flag("--yes", choice->yes,
                    "Let the robot move; without this option everything is checked only");
  command->add_option("--log", choice->log, "File for planned and measured joints (CSV)");
  const auto tolerance = [command](const char* name, double& value, const char* text) {
    command->add_option(name, value, text)
        ->check(positive_number())
        ->check(CLI::Range(1e-5, 1.0))
        ->capture_default_str();
  };
  tolerance("--start-tolerance", choice->tolerances.start,
            "Largest distance of a joint from the path's start, rad");
  tolerance("--following-tolerance", choice->tolerances.following,
            "Largest following error of a joint during a motion, rad");
  command->callback([choice, &exit_code] { exit_code = send(*choice); });
}

}  // namespace handway::tools
