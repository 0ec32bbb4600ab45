#include "motion_sending.h"

#include "commands.h"
#include "handway/execution/motion/motion_log.h"
#include "handway/execution/motion/motion_run.h"
#include "handway/execution/motion/scene_watch.h"
#include "parameter_options.h"
#include "printing.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <span>
#include <utility>

namespace handway::tools {
namespace {

using execution::MotionPart;
using execution::MotionTarget;

constexpr double kProgressPeriod = 0.5;  // s

std::size_t points_of(const std::vector<MotionPart>& parts) {
  std::size_t sum = 0;
  for (const MotionPart& part : parts) {
    sum += part.trajectory.points.size();
  }
  return sum;
}

// Writes the log, and prints the motion's progress now and then. A motion that was paused because
// the scene was edited continues if the rest is free, and else ends.
class SendObserver final : public execution::MotionObserver {
 public:
  SendObserver(const std::vector<MotionTarget>& targets, const std::vector<MotionPart>& parts,
               execution::MotionLog& log, execution::MotionRequests& requests,
               std::stop_source& stop)
      : targets_(targets), parts_(parts), log_(log), requests_(requests), stop_(stop) {}

  // Object of the scene that ended the motion.
  [[nodiscard]] const std::string& obstacle() const { return obstacle_; }

  void on_sample(const execution::MotionSample& sample) override {
    log_.add(sample.time, sample.target, sample.planned, sample.measured);
  }
  void on_part(std::size_t part) override {
    part_begin_ = duration_of(std::span(parts_).first(part));
    if (!parts_[part].name.empty()) {
      print_out("{} of {}: {}\n", part + 1, parts_.size(), parts_[part].name);
      std::fflush(stdout);
    }
  }
  void on_held(const std::string& reason) override {
    print_out("paused: {}\n", reason);
    std::fflush(stdout);
  }
  void on_progress(double time, const std::vector<execution::FollowingError>& errors) override {
    if (requests_.hold) {
      end_hold(time - part_begin_);
    }
    if (time < next_) {
      return;
    }
    next_ += kProgressPeriod;
    std::string line = fmt::format("{:.1f} of {:.1f} s", time, duration_of(parts_));
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      line +=
          fmt::format(", {} error up to {:.4f} rad", targets_[i].kind, errors[i].max().maxCoeff());
    }
    print_out("{}\n", line);
    std::fflush(stdout);
  }

 private:
  // @param time of the part that runs, s.
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
  const std::vector<MotionPart>& parts_;
  execution::MotionLog& log_;
  execution::MotionRequests& requests_;
  std::stop_source& stop_;
  std::string obstacle_;
  double part_begin_ = 0.0;  // s
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
    return log.good() ? kDone : kNotWritten;
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

}  // namespace

CLI::Option* add_send_options(CLI::App& command, SendOptions& options) {
  CLI::Option* to = command.add_option(
      "--to", options.to,
      "Device: arm://HOST[:PORT], hand://HOST[:PORT], both separated by a comma, or "
      "ros://HOST[:PORT][/CONTROLLER][#arm|#hand] (ros2:// for ROS 2)");
  command
      .add_flag("--yes", options.yes,
                "Let the robot move; without this option everything is checked only")
      ->needs(to);
  command.add_option("--log", options.log, "File for planned and measured joints (CSV)")->needs(to);
  for (CLI::Option* tolerance : add_parameter_options(command, parameters_of(options.tolerances))) {
    tolerance->needs(to);
  }
  return to;
}

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

int send_parts(const SendOptions& options, std::vector<MotionTarget>& targets, Sending sending,
               std::stop_source& stop) {
  const double duration = duration_of(sending.parts);
  for (const MotionTarget& target : targets) {
    print_out("{}: {} joints, {} points, {:.2f} s at {:g} % speed\n", target.link->name(),
              target.variables.size(), points_of(sending.parts), duration, 100.0 * sending.speed);
  }
  if (!options.yes) {
    print_error("Nothing was sent. Add --yes to let the robot move.\n");
    return kWrongUsage;
  }
  std::fflush(stdout);
  execution::MotionLog log(options.log, targets);
  const MotionPart& first = sending.parts.front();
  execution::SceneWatch watch(first.trajectory, first.scene);
  const SceneFileWatch edits(std::move(sending.files), [&] { sending.on_edit(watch); });
  execution::MotionRequests requests{.stop = stop.get_token(), .watch = &watch};
  SendObserver observer(targets, sending.parts, log, requests, stop);
  execution::MotionOutcome outcome =
      run_parts(targets, sending.parts, options.tolerances, requests, observer);
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

}  // namespace handway::tools
