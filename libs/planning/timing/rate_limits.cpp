#include "handway/planning/timing/rate_limits.h"

#include "handway/geometric/formats/yaml_element.h"
#include "handway/geometric/io/input_error.h"
#include "handway/planning/core/objective.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace handway::planning {
namespace {

using geometric::RobotModel;
using geometric::YamlElement;

/// Of one joint; 0: not known.
struct JointRates {
  double velocity = 0.0;
  double acceleration = 0.0;
  double jerk = 0.0;
};

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

RateLimits of_variables(const RobotModel& model, const RatesByJoint& rates) {
  const Eigen::Index count = model.variable_count();
  RateLimits limits{Eigen::VectorXd::Zero(count), Eigen::VectorXd::Zero(count),
                    Eigen::VectorXd::Zero(count)};
  const auto narrow = [](double& limit, double other) {
    if (other > 0.0 && (limit == 0.0 || other < limit)) {
      limit = other;
    }
  };
  for (int link = 1; link < model.link_count(); ++link) {
    const RobotModel::Drive& drive = model.drive(link);
    if (drive.variable >= 0 && drive.multiplier != 0.0) {
      const JointRates& joint = rates.find(model.joint(link).name)->second;
      const double scale = std::abs(drive.multiplier);
      narrow(limits.velocity[drive.variable], joint.velocity / scale);
      narrow(limits.acceleration[drive.variable], joint.acceleration / scale);
      narrow(limits.jerk[drive.variable], joint.jerk / scale);
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

[[noreturn]] void refuse_unknown(const YamlElement& joint, const std::string& name,
                                 const RobotModel& model) {
  std::vector<std::string> joints;
  for (int v = 0; v < model.variable_count(); ++v) {
    joints.push_back(model.variable(v).name);
  }
  constexpr std::size_t kFew = 3;
  joint.refuse(fmt::format("\"{}\"", name),
               fmt::format("a joint of the robot \"{}\"", model.name()),
               fmt::format("The nearest are {}.",
                           fmt::join(geometric::nearest_names(name, joints, kFew), ", ")));
}

bool flag(const YamlElement& joint, const std::string& key) {
  const auto element = joint.find(key);
  return !element || element->flag();
}

void read(const YamlElement& joint, const std::string& has, const std::string& key, double& limit) {
  const auto element = joint.find(key);
  if (!element || !flag(joint, has)) {
    return;
  }
  limit = element->number();
  if (limit <= 0.0) {
    element->refuse(element->found(), "a number above 0");
  }
}

}  // namespace

const char* rate_name(Rate rate) {
  switch (rate) {
    case Rate::kVelocity:
      return "velocity";
    case Rate::kAcceleration:
      return "acceleration";
    case Rate::kJerk:
      break;
  }
  return "jerk";
}

RateLimits RateLimits::without_jerk() const {
  RateLimits limits = *this;
  limits.jerk.resize(0);
  std::erase_if(limits.assumed, [](const AssumedLimit& one) { return one.rate == Rate::kJerk; });
  return limits;
}

std::vector<std::string> assumption_lines(const std::vector<AssumedLimit>& assumed,
                                          std::size_t most) {
  const std::array<std::pair<Rate, std::string>, 3> kinds{
      {{Rate::kVelocity, fmt::format("{:g} rad/s or m/s", kDefaultVelocity)},
       {Rate::kAcceleration,
        fmt::format("the velocity limit is reached in {:g} s", kDefaultRampTime)},
       {Rate::kJerk,
        fmt::format("the acceleration limit is reached in {:g} s", kDefaultJerkTime)}}};
  std::vector<std::string> lines;
  for (const auto& [rate, how] : kinds) {
    std::vector<std::string> joints;
    for (const AssumedLimit& one : assumed) {
      if (one.rate == rate) {
        joints.push_back(one.joint);
      }
    }
    if (joints.empty()) {
      continue;
    }
    const std::size_t named = std::min(most, joints.size());
    std::string line = fmt::format(
        "assumed {} limits, as no file has them ({}): {}", rate_name(rate), how,
        fmt::join(joints.begin(), joints.begin() + static_cast<std::ptrdiff_t>(named), ", "));
    if (named < joints.size()) {
      line += fmt::format(" and {} more", joints.size() - named);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

RateLimits rate_limits(const RobotModel& model) {
  const std::filesystem::path& robot = model.description().file;
  const std::filesystem::path file = robot.parent_path() / "joint_limits.yaml";
  if (!robot.empty() && std::filesystem::is_regular_file(file)) {
    return read_rate_limits(model, file);
  }
  return of_variables(model, rates_of(model));
}

RateLimits read_rate_limits(const RobotModel& model, const std::filesystem::path& file) {
  RatesByJoint rates = rates_of(model);
  const YamlElement top = YamlElement::read(file, "a file of joint limits (YAML)");
  for (const auto& [name, joint] : top.need("joint_limits").entries()) {
    joint.allow_keys({"has_velocity_limits", "max_velocity", "has_acceleration_limits",
                      "max_acceleration", "has_jerk_limits", "max_jerk", "has_position_limits",
                      "min_position", "max_position"});
    const auto found = rates.find(name);
    if (found == rates.end()) {
      refuse_unknown(joint, name, model);
    }
    read(joint, "has_velocity_limits", "max_velocity", found->second.velocity);
    read(joint, "has_acceleration_limits", "max_acceleration", found->second.acceleration);
    read(joint, "has_jerk_limits", "max_jerk", found->second.jerk);
  }
  return of_variables(model, rates);
}

}  // namespace handway::planning
