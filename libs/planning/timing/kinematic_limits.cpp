#include "handway/planning/timing/kinematic_limits.h"

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"
#include "handway/planning/core/objective.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace handway::planning {
namespace {

using geometric::RobotModel;
using geometric::YamlElement;

constexpr std::array kRates{Rate::kVelocity, Rate::kAcceleration, Rate::kJerk};

/// Of one joint, by rate; 0: not known.
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

// Puts defaults where there is no limit, and notes it.
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
    const RobotModel::MimicMapping& drive = model.drive(link);
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
  // In this order: one follows from the other.
  assume(model, Rate::kVelocity, Eigen::VectorXd::Constant(count, kDefaultVelocity),
         limits.velocity, limits.assumed);
  assume(model, Rate::kAcceleration, limits.velocity / kDefaultRampTime, limits.acceleration,
         limits.assumed);
  assume(model, Rate::kJerk, limits.acceleration / kDefaultJerkTime, limits.jerk, limits.assumed);
  return limits;
}

// Files may be about more than this robot, as about the gripper on it. But a joint that the file
// leaves out, and nearly names, is meant.
void refuse_slip(const YamlElement& limits, const YamlElement& joint, const std::string& name,
                 const RobotModel& model) {
  std::vector<std::string> left_out;
  for (int v = 0; v < model.variable_count(); ++v) {
    if (!limits.find(model.variable(v).name)) {
      left_out.push_back(model.variable(v).name);
    }
  }
  if (!geometric::slip_of(name, left_out)) {
    return;
  }
  constexpr std::size_t kFew = 3;
  joint.refuse(fmt::format("\"{}\"", name),
               fmt::format("a joint of the robot \"{}\"", model.name()),
               fmt::format("The nearest are {}.",
                           fmt::join(geometric::nearest_names(name, left_out, kFew), ", ")));
}

// The limit of a rate, if the joint's map has one that counts.
void read(const YamlElement& joint, Rate rate, double& limit) {
  const auto element = joint.find(fmt::format("max_{}", rate_name(rate)));
  const auto flag = joint.find(fmt::format("has_{}_limits", rate_name(rate)));
  if (!element || (flag && !flag->flag())) {
    return;
  }
  limit = element->number();
  if (limit <= 0.0) {
    element->refuse(element->found(), "a number above 0");
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
  const std::array defaults{
      fmt::format("{:g} rad/s or m/s", kDefaultVelocity),
      fmt::format("the velocity limit is reached in {:g} s", kDefaultRampTime),
      fmt::format("the acceleration limit is reached in {:g} s", kDefaultJerkTime)};
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
        "assumed {} limits, as no file has them ({}): {}", rate_name(kRates.at(r)), defaults.at(r),
        fmt::join(joints.begin(), joints.begin() + static_cast<std::ptrdiff_t>(named), ", "));
    if (named < joints.size()) {
      line += fmt::format(" and {} more", joints.size() - named);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

JointKinematicLimits rate_limits(const RobotModel& model) {
  const std::filesystem::path& robot = model.description().file;
  const std::filesystem::path file = robot.parent_path() / "joint_limits.yaml";
  if (!robot.empty() && std::filesystem::is_regular_file(file)) {
    return read_joint_kinematic_limits(model, file);
  }
  return of_variables(model, rates_of(model));
}

JointKinematicLimits read_joint_kinematic_limits(const RobotModel& model,
                                                 const std::filesystem::path& file) {
  RatesByJoint rates = rates_of(model);
  YamlElement top = YamlElement::read(file, "a file of joint limits (YAML)");
  for (const char* around : {"/**", "ros__parameters", "robot_description_planning"}) {
    top = top.find(around).value_or(top);
  }
  const YamlElement limits = top.need("joint_limits");
  for (const auto& [name, joint] : limits.entries()) {
    // Of all that ROS has in such files.
    joint.allow_keys({"has_velocity_limits", "max_velocity", "has_acceleration_limits",
                      "max_acceleration", "has_jerk_limits", "max_jerk", "has_position_limits",
                      "min_position", "max_position", "has_deceleration_limits", "max_deceleration",
                      "has_effort_limits", "max_effort", "angle_wraparound", "has_soft_limits",
                      "soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity"});
    const auto found = rates.find(name);
    if (found == rates.end()) {
      refuse_slip(limits, joint, name, model);
      continue;
    }
    for (std::size_t r = 0; r < kRates.size(); ++r) {
      read(joint, kRates.at(r), found->second.at(r));
    }
  }
  return of_variables(model, rates);
}

}  // namespace handway::planning
