#include "send_command.h"

#include "exit_codes.h"
#include "handway/geometric/io/input_error.h"
#include "interrupt.h"
#include "motion_log.h"
#include "number_options.h"
#include "send_run.h"
#include "send_targets.h"
#include "timing_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace handway::tools {
namespace {

// A tenth of the pace, unless somebody asks for more; 20 ms is what an arm's queue of ten
// points can live on.
constexpr double kCautiousSpeed = 0.1;
constexpr double kPeriodMs = 20.0;
// What a joint may turn and still count as standing, rad.
constexpr double kStands = 1e-6;

struct SendChoice {
  TimingChoice timing;
  std::string to;
  std::filesystem::path log;
  device::MotionTolerances tolerances;
  bool yes = false;
};

// The path's start, with what the devices measure in it.
planning::Configuration measured_start(const TimingInput& input,
                                       const std::vector<SendTarget>& targets) {
  planning::Configuration start = input.path.waypoints.front();
  for (const SendTarget& target : targets) {
    const Eigen::VectorXd& position = target.link->measured().position;
    for (std::size_t j = 0; j < target.variables.size(); ++j) {
      start[target.variables[j]] = position[static_cast<Eigen::Index>(j)];
    }
  }
  return start;
}

// Joints without a device have to stand, as nobody would move them.
void check_that_the_rest_stands(const TimingInput& input, const std::vector<SendTarget>& targets,
                                const std::string& to) {
  const planning::Configuration& first = input.path.waypoints.front();
  std::vector<bool> driven(static_cast<std::size_t>(first.size()));
  for (const SendTarget& target : targets) {
    for (const int v : target.variables) {
      driven[static_cast<std::size_t>(v)] = true;
    }
  }
  for (const planning::Configuration& waypoint : input.path.waypoints) {
    for (Eigen::Index v = 0; v < first.size(); ++v) {
      if (!driven[static_cast<std::size_t>(v)] && std::abs(waypoint[v] - first[v]) > kStands) {
        throw geometric::InputError(
            {"--to", "", to, "devices for all joints that the path moves",
             fmt::format("Joint \"{}\" moves, and no device is there for it.",
                         input.problem.model().variable(static_cast<int>(v)).name)});
      }
    }
  }
}

device::JointTrajectory part_of(const planning::Trajectory& trajectory,
                                const std::vector<int>& variables) {
  device::JointTrajectory part;
  part.positions.resize(static_cast<Eigen::Index>(trajectory.points.size()),
                        static_cast<Eigen::Index>(variables.size()));
  for (const planning::TrajectoryPoint& point : trajectory.points) {
    const auto row = static_cast<Eigen::Index>(part.times.size());
    part.times.push_back(point.time - trajectory.points.front().time);
    for (std::size_t j = 0; j < variables.size(); ++j) {
      part.positions(row, static_cast<Eigen::Index>(j)) = point.position[variables[j]];
    }
  }
  return part;
}

void print_errors(const std::vector<SendTarget>& targets, const SendOutcome& outcome) {
  fmt::print("following error, rad:\n{:<24}{:>10}{:>10}\n", "", "max", "RMS");
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Eigen::VectorXd rms = outcome.errors[i].rms();
    for (Eigen::Index j = 0; j < rms.size(); ++j) {
      fmt::print("{:<24}{:>10.5f}{:>10.5f}\n",
                 targets[i].link->joints().names[static_cast<std::size_t>(j)],
                 outcome.errors[i].max()[j], rms[j]);
    }
  }
}

int report(const std::vector<SendTarget>& targets, const SendOutcome& outcome, const MotionLog& log,
           double duration) {
  print_errors(targets, outcome);
  if (!log.good()) {
    fmt::print(stderr, "The log could not be written to its end.\n");
  }
  if (outcome.done) {
    fmt::print("done: {:.2f} s\n", duration);
    return log.good() ? kDone : kInvalidInput;
  }
  std::fflush(stdout);
  if (!outcome.fault.empty()) {
    fmt::print(stderr, "{}\n", outcome.fault);
  }
  fmt::print("STOPPED at {:.2f} of {:.2f} s: {}; all devices told to stop within {:.1f} ms, ",
             outcome.time, duration, outcome.fault.empty() ? "on request" : "after a fault",
             outcome.stop_sent_ms);
  if (outcome.at_rest_ms >= 0.0) {
    fmt::print("at rest {:.0f} ms later\n", outcome.at_rest_ms);
  } else {
    fmt::print("not seen at rest: LOOK AT THE ROBOT\n");
  }
  return kMotionStopped;
}

int send(const SendChoice& choice) {
  planning::Extensions extensions;
  extensions.load_plugins(planning::plugin_directory());
  const TimingInput input = read_timing_input(choice.timing, extensions);
  std::vector<SendTarget> targets = parse_targets(choice.to, input.problem);
  check_that_the_rest_stands(input, targets, choice.to);
  std::stop_source stop;
  const StopsOnInterrupt guard(stop);
  for (const SendTarget& target : targets) {
    target.link->connect(stop.get_token());
  }
  const planning::TimedPath timed =
      run_timing(choice.timing, input, measured_start(input, targets), choice.tolerances.start);
  print_timing(timed);
  if (!timed.cleared()) {
    return kNoPath;
  }
  const double duration = timed.motion.trajectory.duration();
  for (const SendTarget& target : targets) {
    fmt::print("{}: {} joints, {} points, {:.2f} s at {:g} % speed\n", target.link->name(),
               target.variables.size(), timed.motion.trajectory.points.size(), duration,
               100.0 * choice.timing.speed);
  }
  if (!choice.yes) {
    fmt::print(stderr, "Nothing was sent: --yes lets the robot move.\n");
    return kWrongUsage;
  }
  std::fflush(stdout);
  MotionLog log(choice.log, targets);
  for (const SendTarget& target : targets) {
    // Timing took a while, in which nobody listened to it.
    target.link->update();
    target.link->upload(part_of(timed.motion.trajectory, target.variables));
  }
  if (stop.stop_requested()) {
    fmt::print(stderr, "Nothing moved: stopped before the start.\n");
    return kMotionStopped;
  }
  const SendOutcome outcome = run_motion(targets, choice.tolerances, log, stop.get_token());
  return report(targets, outcome, log, duration);
}

}  // namespace

void add_send_command(CLI::App& app, int& exit_code) {
  auto choice = std::make_shared<SendChoice>();
  choice->timing.speed = kCautiousSpeed;
  choice->timing.period_ms = kPeriodMs;
  CLI::App* command = app.add_subcommand("send", "Run a path on an arm and a hand");
  add_timing_options(*command, choice->timing);
  command
      ->add_option("--to", choice->to,
                   "arm://HOST[:PORT], hand://HOST[:PORT] or both with a comma between")
      ->required();
  command->add_flag("--yes", choice->yes, "Let the robot move");
  command->add_option("--log", choice->log, "Where to write planned and measured joints (CSV)");
  const auto tolerance = [command](const char* name, double& value, const char* text) {
    command->add_option(name, value, text)
        ->check(positive_number())
        ->check(CLI::Range(1e-5, 1.0))
        ->capture_default_str();
  };
  tolerance("--start-tolerance", choice->tolerances.start,
            "How far a joint may stand from the path's start, rad");
  tolerance("--following-tolerance", choice->tolerances.following,
            "How far a joint may be from where it should be, rad");
  command->callback([choice, &exit_code] { exit_code = send(*choice); });
}

}  // namespace handway::tools
