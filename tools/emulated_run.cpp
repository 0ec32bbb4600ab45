#include "emulated_run.h"

#include "handway/device/emulators/arm_emulator.h"
#include "handway/device/emulators/hand_emulator.h"
#include "handway/execution/motion/motion_run.h"
#include "handway/execution/motion/motion_target.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace handway::tools {
namespace {

using execution::MotionSample;
using execution::MotionTarget;

template <typename Settings>
Settings at_start(const planning::PlanningProblem& problem, const char* kind) {
  Settings settings;
  const geometric::JointIndices variables = problem.joints.of_part(kind);
  settings.joints = execution::device_joints(problem.model(), variables);
  settings.position = problem.start(variables);
  return settings;
}

class SampleRecorder final : public execution::MotionObserver {
 public:
  explicit SampleRecorder(std::size_t devices) : samples_(devices) {}

  void on_sample(const MotionSample& sample) override { samples_[sample.target].push_back(sample); }
  void on_progress(double /*time*/,
                   const std::vector<execution::FollowingError>& /*errors*/) override {}

  // Positions measured at `time`, linear between the device's reports; @pre there are some.
  [[nodiscard]] Eigen::VectorXd measured(std::size_t device, double time) const {
    const std::vector<MotionSample>& samples = samples_[device];
    const auto after = std::ranges::lower_bound(samples, time, {}, &MotionSample::time);
    if (after == samples.begin()) {
      return after->measured;
    }
    if (after == samples.end()) {
      return samples.back().measured;
    }
    const MotionSample& before = *(after - 1);
    const double step = after->time - before.time;
    const double share = step > 0.0 ? (time - before.time) / step : 1.0;
    return before.measured + share * (after->measured - before.measured);
  }
  [[nodiscard]] bool has_samples() const {
    return std::ranges::none_of(samples_, [](const auto& samples) { return samples.empty(); });
  }

 private:
  std::vector<std::vector<MotionSample>> samples_;  ///< By device, in order of time.
};

planning::Configuration position_at(const planning::Trajectory& trajectory, double time) {
  const auto& points = trajectory.points;
  const auto after = std::ranges::lower_bound(points, time, {}, &planning::TrajectoryPoint::time);
  if (after == points.begin() || after == points.end()) {
    return after == points.end() ? points.back().position : after->position;
  }
  const planning::TrajectoryPoint& before = *(after - 1);
  const double share = (time - before.time) / (after->time - before.time);
  return before.position + share * (after->position - before.position);
}

std::string fault_of(const execution::MotionOutcome& outcome) {
  if (outcome.done) {
    return "";
  }
  return outcome.fault.empty() ? "The motion was stopped." : outcome.fault;
}

}  // namespace

EmulatedRun run_on_emulators(const planning::PlanningProblem& problem,
                             const planning::Motion& motion, int points) {
  const device::ArmEmulator arm(at_start<device::Val3ControllerSettings>(problem, "arm"), 0);
  const device::HandEmulator hand(at_start<device::HandControllerSettings>(problem, "hand"), 0);
  std::vector<MotionTarget> targets =
      execution::parse_targets(arm.address() + "," + hand.address(), problem);
  for (const MotionTarget& target : targets) {
    target.link->connect();
    target.link->upload(execution::part_of(motion.trajectory, target.variables));
  }
  SampleRecorder recorder(targets.size());
  execution::MotionRequests requests;
  const execution::MotionOutcome outcome = run_motion(targets, {}, requests, recorder);
  EmulatedRun run;
  run.duration = motion.trajectory.duration();
  run.fault = fault_of(outcome);
  if (!recorder.has_samples()) {
    return run;
  }
  for (int i = 0; i < points; ++i) {
    const double time = run.duration * i / (points - 1);
    planning::Configuration planned = position_at(motion.trajectory, time);
    planning::Configuration measured = planned;
    for (std::size_t device = 0; device < targets.size(); ++device) {
      measured(targets[device].variables) = recorder.measured(device, time);
    }
    run.times.push_back(time);
    run.planned.push_back(std::move(planned));
    run.measured.push_back(std::move(measured));
  }
  return run;
}

}  // namespace handway::tools
