#include "model/devices/executed_motion.h"

#include "handway/planning/paths/safety_clearance.h"

#include <algorithm>
#include <cstdlib>

namespace handway::gui {
namespace {

Eigen::Index place_of(const std::vector<int>& variables, int variable) {
  const auto found = std::ranges::find(variables, variable);
  return found == variables.end() ? -1 : found - variables.begin();
}

}  // namespace

ExecutedMotion::JointCurve ExecutedMotion::curve(int variable) const {
  JointCurve curve;
  for (const Device& device : devices) {
    const Eigen::Index j = place_of(device.variables, variable);
    if (j < 0) {
      continue;
    }
    for (const execution::MotionSample& sample : device.samples) {
      curve.times.push_back(sample.time);
      curve.planned.push_back(sample.planned[j]);
      curve.measured.push_back(sample.measured[j]);
    }
  }
  return curve;
}

int ExecutedMotion::worst_variable() const {
  int worst = -1;
  double farthest = -1.0;
  for (const Device& device : devices) {
    for (const execution::MotionSample& sample : device.samples) {
      Eigen::Index j = 0;
      const double away = (sample.measured - sample.planned).cwiseAbs().maxCoeff(&j);
      if (away > farthest) {
        farthest = away;
        worst = device.variables[static_cast<std::size_t>(j)];
      }
    }
  }
  return worst;
}

Eigen::VectorXd ExecutedMotion::following_error(const geometric::RobotModel& model) const {
  constexpr double kLeastShare = 0.02;  // of the velocity limit: slower tells nothing of more
  Eigen::VectorXd at_limit = planning::assumed_following_error(model);
  const Eigen::VectorXd limits = planning::rate_limits(model).velocity;
  for (const Device& device : devices) {
    for (const int variable : device.variables) {
      const JointCurve seen = curve(variable);
      double error = 0.0;
      double velocity = 0.0;
      for (std::size_t i = 0; i < seen.times.size(); ++i) {
        error = std::max(error, std::abs(seen.measured[i] - seen.planned[i]));
        if (i > 0 && seen.times[i] > seen.times[i - 1]) {
          velocity = std::max(velocity, std::abs(seen.planned[i] - seen.planned[i - 1]) /
                                            (seen.times[i] - seen.times[i - 1]));
        }
      }
      const double share = std::min(velocity / limits[variable], 1.0);
      if (share > kLeastShare) {
        at_limit[variable] = std::max(error - planning::kErrorAtRest, 0.0) / share;
      }
    }
  }
  return at_limit;
}

std::vector<Eigen::Vector3d> ExecutedMotion::link_path(const geometric::RobotInstance& robot,
                                                       int link) const {
  struct Seen {
    const Device* device;
    const execution::MotionSample* sample;
  };
  std::vector<Seen> all;
  for (const Device& device : devices) {
    for (const execution::MotionSample& sample : device.samples) {
      all.push_back({&device, &sample});
    }
  }
  std::ranges::stable_sort(all, {}, [](const Seen& seen) { return seen.sample->time; });
  geometric::Configuration q = start;
  std::vector<geometric::Pose> X_BL(static_cast<std::size_t>(robot.model->link_count()));
  std::vector<Eigen::Vector3d> curve;
  for (const Seen& seen : all) {
    for (std::size_t j = 0; j < seen.device->variables.size(); ++j) {
      q[seen.device->variables[j]] = seen.sample->measured[static_cast<Eigen::Index>(j)];
    }
    robot.model->forward_kinematics(q, X_BL);
    curve.emplace_back(robot.X_WB * X_BL[static_cast<std::size_t>(link)].translation());
  }
  return curve;
}

}  // namespace handway::gui
