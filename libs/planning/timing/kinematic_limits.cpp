#include "handway/planning/timing/kinematic_limits.h"

#include "handway/geometric/formats/joint_limits_file.h"
#include "handway/planning/core/objective.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace handway::planning {
namespace {

using geometric::RobotModel;

constexpr double kEndless = std::numeric_limits<double>::infinity();

constexpr std::array kRates{Rate::kVelocity, Rate::kAcceleration, Rate::kJerk};

/// Rates of one joint, in the order of kRates; 0: not known.
using JointRates = std::array<double, kRates.size()>;
using RatesByJoint = std::map<std::string, JointRates, std::less<>>;

double known(double limit) { return std::isfinite(limit) && limit > 0.0 ? limit : 0.0; }

RatesByJoint rates_of(const RobotModel& model) {
  RatesByJoint rates;
  for (int link = 1; link < model.link_count(); ++link) {
    const geometric::JointLimits& limits = model.joint(link).limits;
    rates[model.joint(link).name] = {known(limits.velocity), known(limits.acceleration), 0.0};
  }
  return rates;
}

// Sets defaults for missing limits, and records them.
void assume(const RobotModel& model, Rate rate, const Eigen::VectorXd& defaults,
            Eigen::VectorXd& limits, std::vector<AssumedLimit>& assumed) {
  for (int v = 0; v < model.variable_count(); ++v) {
    if (limits[v] == 0.0) {
      limits[v] = defaults[v];
      assumed.push_back({model.variable(v).name, rate, limits[v]});
    }
  }
}

JointKinematicLimits of_variables(const RobotModel& model, const RatesByJoint& rates) {
  const Eigen::Index count = model.variable_count();
  JointKinematicLimits limits{Eigen::VectorXd::Zero(count), Eigen::VectorXd::Zero(count),
                              Eigen::VectorXd::Zero(count)};
  const std::array all{&limits.velocity, &limits.acceleration, &limits.jerk};
  for (int link = 1; link < model.link_count(); ++link) {
    const RobotModel::MimicMapping& drive = model.mimic_mapping(link);
    if (drive.variable < 0 || drive.multiplier == 0.0) {
      continue;
    }
    const JointRates& joint = rates.find(model.joint(link).name)->second;
    for (std::size_t r = 0; r < kRates.size(); ++r) {
      const double own = joint.at(r) / std::abs(drive.multiplier);
      double& limit = (*all.at(r))[drive.variable];
      if (own > 0.0 && (limit == 0.0 || own < limit)) {
        limit = own;
      }
    }
  }
  // In this order: each follows from the one before.
  assume(model, Rate::kVelocity, Eigen::VectorXd::Constant(count, kDefaultVelocity),
         limits.velocity, limits.assumed);
  assume(model, Rate::kAcceleration, limits.velocity / kDefaultRampTime, limits.acceleration,
         limits.assumed);
  assume(model, Rate::kJerk, limits.acceleration / kDefaultJerkTime, limits.jerk, limits.assumed);
  return limits;
}

// Limits of positions that are narrower than the robot's own, of variables and their followers.
void narrow_positions(const RobotModel& model,
                      const std::vector<geometric::FiledJointLimits>& filed,
                      JointKinematicLimits& limits) {
  Eigen::VectorXd lower = Eigen::VectorXd::Constant(model.variable_count(), -kEndless);
  Eigen::VectorXd upper = -lower;
  for (int link = 1; link < model.link_count(); ++link) {
    const auto& [v, multiplier, offset] = model.mimic_mapping(link);
    const auto joint =
        std::ranges::find(filed, model.joint(link).name, &geometric::FiledJointLimits::joint);
    if (v < 0 || multiplier == 0.0 || joint == filed.end()) {
      continue;
    }
    double least = (joint->lower.value_or(-kEndless) - offset) / multiplier;
    double most = (joint->upper.value_or(kEndless) - offset) / multiplier;
    if (multiplier < 0.0) {
      std::swap(least, most);
    }
    lower[v] = std::max(lower[v], least);
    upper[v] = std::min(upper[v], most);
  }
  if ((lower.array() > -kEndless).any() || (upper.array() < kEndless).any()) {
    limits.lower = std::move(lower);
    limits.upper = std::move(upper);
  }
}

}  // namespace

const char* rate_name(Rate rate) {
  static constexpr std::array kNames{"velocity", "acceleration", "jerk"};
  return kNames.at(static_cast<std::size_t>(rate));
}

JointKinematicLimits JointKinematicLimits::without_jerk() const {
  JointKinematicLimits limits = *this;
  limits.jerk.resize(0);
  std::erase_if(limits.assumed, [](const AssumedLimit& one) { return one.rate == Rate::kJerk; });
  return limits;
}

std::vector<std::string> assumption_lines(const std::vector<AssumedLimit>& assumed,
                                          std::size_t most) {
  const std::array defaults{fmt::format("{:g} rad/s or m/s", kDefaultVelocity),
                            fmt::format("full speed in {:g} s", kDefaultRampTime),
                            fmt::format("full acceleration in {:g} s", kDefaultJerkTime)};
  std::vector<std::string> lines;
  for (std::size_t r = 0; r < kRates.size(); ++r) {
    std::vector<std::string> joints;
    for (const AssumedLimit& one : assumed) {
      if (one.rate == kRates.at(r)) {
        joints.push_back(one.joint);
      }
    }
    if (joints.empty()) {
      continue;
    }
    const std::size_t named = std::min(most, joints.size());
    std::string line = fmt::format(
        "no {} limits given; assuming {}: {}", rate_name(kRates.at(r)), defaults.at(r),
        fmt::join(joints.begin(), joints.begin() + static_cast<std::ptrdiff_t>(named), ", "));
    if (named < joints.size()) {
      line += fmt::format(" and {} more", joints.size() - named);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

JointKinematicLimits rate_limits(const RobotModel& model) {
  const std::filesystem::path file = geometric::joint_limits_beside(model.description());
  if (!file.empty()) {
    return read_joint_kinematic_limits(model, file);
  }
  return of_variables(model, rates_of(model));
}

JointKinematicLimits read_joint_kinematic_limits(const RobotModel& model,
                                                 const std::filesystem::path& file) {
  RatesByJoint rates = rates_of(model);
  const std::vector<geometric::FiledJointLimits> filed =
      geometric::read_joint_limits(file, model.description());
  for (const geometric::FiledJointLimits& joint : filed) {
    if (const auto found = rates.find(joint.joint); found != rates.end()) {
      JointRates& known = found->second;
      known = {joint.velocity.value_or(known[0]), joint.acceleration.value_or(known[1]),
               joint.jerk.value_or(known[2])};
    }
  }
  JointKinematicLimits limits = of_variables(model, rates);
  narrow_positions(model, filed, limits);
  return limits;
}

}  // namespace handway::planning
