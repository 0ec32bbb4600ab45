#include "handway/planning/timing/rate_limits.h"

#include "handway/geometric/io/yaml_element.h"

#include <cmath>
#include <map>
#include <string>

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
  for (Eigen::Index v = 0; v < count; ++v) {
    limits.velocity[v] = limits.velocity[v] > 0.0 ? limits.velocity[v] : kDefaultVelocity;
    limits.acceleration[v] = limits.acceleration[v] > 0.0 ? limits.acceleration[v]
                                                          : limits.velocity[v] / kDefaultRampTime;
    limits.jerk[v] =
        limits.jerk[v] > 0.0 ? limits.jerk[v] : limits.acceleration[v] / kDefaultJerkTime;
  }
  return limits;
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
    JointRates other;
    JointRates& taken = found == rates.end() ? other : found->second;
    read(joint, "has_velocity_limits", "max_velocity", taken.velocity);
    read(joint, "has_acceleration_limits", "max_acceleration", taken.acceleration);
    read(joint, "has_jerk_limits", "max_jerk", taken.jerk);
  }
  return of_variables(model, rates);
}

}  // namespace handway::planning
