#include "handway/execution/motion/motion_parts.h"

#include "handway/geometric/collision/volumes/preparation.h"
#include "handway/planning/core/planning_problem.h"
#include "handway/planning/tasks/timed_task.h"
#include "motion_rest.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace handway::execution {
namespace {

using planning::Configuration;
using planning::Motion;
using planning::MotionStage;
using planning::Trajectory;
using planning::TrajectoryPoint;

// Least time in which the fingers squeeze an object, s.
constexpr double kLeastSqueezeTime = 0.3;

SceneWatch::ProblemSource scene_of(const planning::SceneState& state) {
  return [state](const std::stop_token& stop) -> SceneWatch::Problem {
    try {
      return std::make_shared<const planning::PlanningProblem>(
          planning::make_problem(state.scene, state.basis, {.stop = stop}));
    } catch (const geometric::PreparationStopped&) {
      return nullptr;
    }
  };
}

// The hand at an object: the joints touch it, and their targets squeeze it.
struct Grip {
  Configuration closed;
  Configuration squeezed;

  Grip(const Motion& motion, Configuration at_contact, const Configuration& targets)
      : closed(std::move(at_contact)), squeezed(closed) {
    squeezed(motion.hand) = targets(motion.hand);
  }

  // While the joints are between both.
  [[nodiscard]] Configuration give() const { return (squeezed - closed).cwiseAbs(); }
};

TrajectoryPoint at_rest(double time, const Configuration& q) {
  return {time, q, Eigen::VectorXd::Zero(q.size()), Eigen::VectorXd::Zero(q.size())};
}

// Time between the points of a motion, s.
double period_of(const Motion& motion) {
  constexpr double kUsual = 0.02;  // of a motion in which nothing moves
  for (std::size_t i = 0; i < motion.stages.size(); ++i) {
    const std::span<const TrajectoryPoint> points = planning::points_of_stage(motion, i);
    if (!motion.stages[i].waits && points.size() > 1) {
      return points[1].time - points[0].time;
    }
  }
  return kUsual;
}

// Moves in a straight line, with a smooth begin and end, at the speed of the motion.
Trajectory squeeze(const Motion& motion, const Configuration& from, const Configuration& to) {
  constexpr double kPeak = 1.5;  // largest velocity of 3 u² - 2 u³
  const Eigen::VectorXd velocity = motion.speed * motion.limits.velocity;
  const double duration = std::max(
      kLeastSqueezeTime, kPeak * ((to - from).cwiseAbs().cwiseQuotient(velocity)).maxCoeff());
  const double period = period_of(motion);
  const int steps = static_cast<int>(std::ceil(duration / period));
  Trajectory line;
  for (int i = 0; i <= steps; ++i) {
    const double u = static_cast<double>(i) / steps;
    line.points.push_back(at_rest(i * period, from + u * u * (3.0 - 2.0 * u) * (to - from)));
  }
  return line;
}

// The points of a stage, with the hand at the targets that squeeze the object.
Trajectory stage_trajectory(const Motion& motion, std::size_t stage,
                            const std::optional<Grip>& grip) {
  const std::span<const TrajectoryPoint> points = planning::points_of_stage(motion, stage);
  Trajectory trajectory{{points.begin(), points.end()}};
  if (grip) {
    for (TrajectoryPoint& point : trajectory.points) {
      point.position(motion.hand) = grip->squeezed(motion.hand);
    }
  }
  return trajectory;
}

// Forwards what happens in one part to the observer of the whole motion.
class PartObserver final : public MotionObserver {
 public:
  PartObserver(MotionObserver& observer, double begin, double duration,
               const std::vector<FollowingError>& before)
      : observer_(observer), begin_(begin), duration_(duration), before_(before) {}

  void on_sample(const MotionSample& sample) override {
    observer_.on_sample({time_of(sample.time), sample.target, sample.planned, sample.measured});
  }
  void on_progress(double time, const std::vector<FollowingError>& errors) override {
    std::vector<FollowingError> all = errors;
    for (std::size_t i = 0; i < before_.size(); ++i) {
      all[i].add(before_[i]);
    }
    observer_.on_progress(time_of(time), all);
  }
  void on_held(const std::string& reason) override { observer_.on_held(reason); }

 private:
  // Time of the whole motion, which stands still until the next part begins.
  [[nodiscard]] double time_of(double time) const { return begin_ + std::min(time, duration_); }

  MotionObserver& observer_;
  double begin_;
  double duration_;
  const std::vector<FollowingError>& before_;
};

// Adds the outcome of a part that began at `begin` (s).
void append(const MotionOutcome& part, double begin, MotionOutcome& all) {
  all.started |= part.started;
  all.done = part.done;
  all.fault = part.fault;
  all.collision = part.collision;
  all.time = begin + part.time;
  all.stop_sent_ms = part.stop_sent_ms;
  all.stop_sent = part.stop_sent;
  all.at_rest_ms = part.at_rest_ms;
  if (all.errors.empty()) {
    all.errors = part.errors;
    return;
  }
  for (std::size_t i = 0; i < part.errors.size(); ++i) {
    all.errors[i].add(part.errors[i]);
  }
}

// The devices rest, and are polled until no hold is requested any more.
void wait_while_held(const std::vector<MotionTarget>& targets, const MotionRequests& requests) {
  while (requests.hold && !requests.stop.stop_requested()) {
    for (const MotionTarget& target : targets) {
      target.link->update();
    }
  }
}

MotionOutcome run_part(std::vector<MotionTarget>& targets, const MotionPart& part,
                       device::MotionTolerances tolerances, MotionRequests& requests,
                       MotionObserver& observer) {
  for (const MotionTarget& target : targets) {
    target.link->update();
    target.link->upload(part_of(part.trajectory, target.variables));
  }
  tolerances.give = part.give;
  return run_motion(targets, tolerances, requests, observer);
}

std::string name_of(const MotionStage& stage) {
  return stage.waits ? stage.step : fmt::format("{} ({})", stage.name, stage.step);
}

// Runs a part that is not the first: what keeps it from its begin is a fault.
MotionOutcome run_later_part(std::vector<MotionTarget>& targets, const MotionPart& part,
                             const device::MotionTolerances& tolerances, MotionRequests& requests,
                             MotionObserver& observer) {
  try {
    wait_while_held(targets, requests);
    return run_part(targets, part, tolerances, requests, observer);
  } catch (const std::exception& error) {
    MotionOutcome outcome;
    outcome.fault = error.what();
    for (const MotionTarget& target : targets) {
      target.link->stop();
    }
    outcome.at_rest_ms = 0.0;
    return outcome;
  }
}

}  // namespace

std::vector<MotionPart> parts_of(const Motion& motion,
                                 const std::vector<planning::SceneState>& scenes) {
  std::vector<MotionPart> parts;
  std::optional<Grip> grip;
  for (std::size_t i = 0; i < motion.stages.size(); ++i) {
    const MotionStage& stage = motion.stages[i];
    if (grip && stage.hand == planning::HandAction::kOpen) {
      const Configuration& begin = planning::points_of_stage(motion, i).front().position;
      const Grip here(motion, begin, grip->squeezed);
      parts.push_back({fmt::format("release ({})", stage.step),
                       squeeze(motion, here.squeezed, here.closed), scene_of(scenes[i]), i,
                       here.give()});
      grip.reset();
    }
    if (stage.output) {
      continue;
    }
    MotionPart part{name_of(stage), stage_trajectory(motion, i, grip), scene_of(scenes[i]), i};
    part.rests = stage.waits;
    if (grip) {
      part.give = grip->give();
    }
    parts.push_back(std::move(part));
    if (stage.squeezed.size() > 0 && i + 1 < motion.stages.size()) {
      grip.emplace(motion, planning::points_of_stage(motion, i).back().position, stage.squeezed);
      parts.push_back({fmt::format("hold ({})", stage.step),
                       squeeze(motion, grip->closed, grip->squeezed), scene_of(scenes[i + 1]),
                       i + 1, grip->give()});
    }
  }
  if (parts.empty()) {  // the motion sets outputs alone
    parts.push_back({.name = motion.stages.back().step,
                     .trajectory = motion.trajectory,
                     .scene = scene_of(scenes.back()),
                     .rests = true});
  }
  return parts;
}

std::string unset_outputs(const Motion& motion) {
  std::vector<std::string> names;
  for (const geometric::OutputStep& output : outputs_of(motion)) {
    names.push_back(fmt::format("{} to {}", output.name, value_text(output)));
  }
  return names.empty()
             ? std::string()
             : fmt::format("The devices do not set these outputs: {}.", fmt::join(names, ", "));
}

double duration_of(std::span<const MotionPart> parts) {
  double sum = 0.0;
  for (const MotionPart& part : parts) {
    sum += part.trajectory.duration();
  }
  return sum;
}

MotionOutcome run_parts(std::vector<MotionTarget>& targets, const std::vector<MotionPart>& parts,
                        const device::MotionTolerances& tolerances, MotionRequests& requests,
                        MotionObserver& observer) {
  MotionOutcome all;
  double begin = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (requests.watch && i > 0) {
      requests.watch->begin(parts[i].trajectory, parts[i].scene);
    }
    observer.on_part(i);
    const double duration = parts[i].trajectory.duration();
    PartObserver of_part(observer, begin, duration, all.errors);
    const MotionOutcome outcome =
        parts[i].rests ? run_rest(targets, parts[i], tolerances, requests, of_part)
        : i == 0       ? run_part(targets, parts[i], tolerances, requests, of_part)
                       : run_later_part(targets, parts[i], tolerances, requests, of_part);
    append(outcome, begin, all);
    if (!outcome.done) {
      break;
    }
    begin += duration;
  }
  return all;
}

}  // namespace handway::execution
